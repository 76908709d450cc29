// What a plane cuts away, against geometry: a tube along x of 5 mm radius, seen from the front (+y) without
// perspective, 0.1 mm a pixel.
#include "render/scene/late_picture.h"
#include "tests/support/beside_scene.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;
using namespace ramus::test;

namespace {

struct CutScene : BesideScene {
    Image background; // what an empty scene shows

    explicit CutScene(GlVersion newest = {99, 0}) : BesideScene(newest) {
        frame.appearance.occlusion = 0.0F;
        const auto mesh = std::exchange(frame.mesh, nullptr);
        background = picture();
        frame.mesh = mesh;
    }
    // The colour of a flat surface of branch 0 that faces `normal`, at the middle of the picture.
    [[nodiscard]] std::array<int, 3> flat_colour(const glm::dvec3& normal) const {
        ramus::mesh::TriangleMesh plate;
        const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.2, 0.9)));
        const glm::dvec3 up = glm::cross(normal, side);
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            plate.positions.emplace_back(3.0 * (corner.x * side + corner.y * up));
            plate.normals.emplace_back(normal);
            plate.radii.push_back(1.0F);
            plate.branches.push_back(0);
        }
        plate.triangles = {{0, 1, 2}, {0, 2, 3}};
        Frame flat = frame;
        flat.mesh = std::make_shared<const PagedMesh>(plate);
        flat.cut_away.reset();
        flat.planes.clear();
        const auto other = Renderer::create().value();
        REQUIRE(other->draw(flat));
        const Image image = other->read_image();
        const std::uint8_t* p = image.pixel(image.width / 2, image.height / 2);
        return {p[0], p[1], p[2]};
    }
    [[nodiscard]] bool shows(const Image& image, double x, double z, const std::array<int, 3>& colour) const {
        const std::uint8_t* p = this->colour(image, x, z);
        return std::abs(p[0] - colour[0]) <= 1 && std::abs(p[1] - colour[1]) <= 1 && std::abs(p[2] - colour[2]) <= 1;
    }
    [[nodiscard]] bool empty(const Image& image, double x, double z) const {
        return apart(colour(image, x, z), colour(background, x, z)) == 0;
    }
};

} // namespace

TEST_CASE("a tube that is cut along its axis shows a flat cap, and nothing of what is removed") {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(newest.text());
        CutScene scene(newest);
        scene.frame.cut_away = CutAway{{0, 0, 0}, {0, 1, 0}};
        const Image cut = scene.picture();
        const auto cap = scene.flat_colour({0, 1, 0});
        for (double x = -24.75; x < 25.0; x += 1.1)
            for (double z = -6.0; z < 6.0; z += 0.25) {
                const double beyond = std::max(0.0, std::abs(x) - 20.0), from_axis = std::hypot(beyond, z);
                if (std::abs(from_axis - kTube) < 0.2) continue;
                CAPTURE(x);
                CAPTURE(z);
                if (from_axis < kTube)
                    CHECK(scene.shows(cut, x, z, cap));
                else
                    CHECK(scene.empty(cut, x, z));
            }
        const Pick pick = scene.pick(3, 2);
        CHECK(pick.branch == 0);
        CHECK(glm::distance(pick.position, glm::dvec3(3, 0, 2)) < 0.1);
        const auto map = scene.renderer->read_depths();
        REQUIRE(map);
        const auto point = map->point_at(glm::dvec2(scene.at(3, 2)) + 0.5, 2.0);
        REQUIRE(point);
        CHECK(std::abs(point->y) < 0.05);
        CHECK_FALSE(scene.draw().shaded);
        // From behind nothing is seen of the cut.
        scene.frame.cut_away.reset();
        const Image whole = scene.picture();
        scene.frame.cut_away = CutAway{{0, 0, 0}, {0, -1, 0}};
        const auto difference = compare(scene.picture(), whole, 1);
        REQUIRE(difference);
        CHECK(difference->fraction() < 0.01); // only the outline, which lies in the plane
    }
}

TEST_CASE("an aslant cut is lit by the plane's normal and lies in the plane") {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(newest.text());
        CutScene scene(newest);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 1, 0));
        scene.frame.cut_away = CutAway{{0, 0, 0}, normal}; // removed: x + y > 0
        const Image cut = scene.picture();
        const auto cap = scene.flat_colour(normal);
        for (const double z : {0.0, 3.0, -4.0})
            for (double x = -10.0; x < 10.0; x += 0.1) {
                const double half = std::sqrt(kTube * kTube - z * z); // the tube's y there
                if (std::abs(std::abs(x) - half) < 0.2) continue;
                CAPTURE(x);
                CAPTURE(z);
                if (std::abs(x) < half) {
                    CHECK(scene.shows(cut, x, z, cap));
                } else if (x > half) {
                    CHECK(scene.empty(cut, x, z));
                }
            }
        for (const double x : {-3.0, 2.0}) {
            const Pick pick = scene.pick(x, 1);
            CHECK(pick.branch == 0);
            CHECK(std::abs(pick.position.x + pick.position.y) < 0.15);
        }
    }
}

TEST_CASE("caps win over a slice in the same plane, which shows around them, and over what is behind them") {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const double turn : {0.0, 31.0}) {
            CAPTURE(newest.text());
            CAPTURE(turn);
            CutScene scene(newest);
            scene.frame.camera = turned(scene.frame.camera, turn, 0.6 * turn);
            scene.frame.cut_away = CutAway{{0, 0, 0}, {0, 1, 0}};
            scene.frame.context.push_back( // a ball inside the tube's rest, and one that is removed
                {std::make_shared<const ramus::mesh::TriangleMesh>(icosphere(4, glm::dvec3(0, -2, 0), 1.5)), nullptr,
                 kColour, 1.0F, false});
            scene.frame.context.push_back(
                {std::make_shared<const ramus::mesh::TriangleMesh>(icosphere(4, glm::dvec3(6, 12, 0), 3)), nullptr,
                 kColour, 1.0F, false});
            const Image caps = scene.picture();
            Image picture(2, 2);
            picture.fill(glm::vec3(100.0F / 255.0F));
            scene.frame.planes = {{{12, 0, 8},
                                   {-24, 0, 0},
                                   {0, 0, -16},
                                   std::make_shared<const LatePicture>(picture),
                                   glm::vec3(0.9F),
                                   0.0F}};
            const Image both = scene.picture();
            int seen = 0;
            for (double x = -11.5; x < 11.6; x += 0.23)
                for (double z = -7.5; z < 7.6; z += 0.17) {
                    if (std::abs(std::abs(z) - kTube) < 0.25) continue;
                    const glm::dvec3 at = *project(scene.frame.camera, scene.frame.size, {x, 0, z});
                    const std::uint8_t* p = both.pixel(int(at.x), int(at.y));
                    const std::uint8_t* cap = caps.pixel(int(at.x), int(at.y));
                    CAPTURE(x);
                    CAPTURE(z);
                    const bool inside = std::abs(z) < kTube;
                    if (inside)
                        CHECK(apart(p, cap) == 0);
                    else
                        CHECK((p[0] == 100 && p[1] == 100 && p[2] == 100));
                    seen += inside ? 1 : 0;
                }
            CHECK(seen > 1000);
        }
}

TEST_CASE("a cut through glass and solid context opens the one and caps the other") {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(newest.text());
        CutScene scene(newest);
        scene.frame.states[0] = BranchState::kHidden;
        scene.add_sphere(1.0F);
        scene.frame.cut_away = CutAway{{0, 3, 0}, {0, 1, 0}};
        const Image solid = scene.picture();
        const double radius = std::sqrt(kSphere * kSphere - 9.0);
        const std::uint8_t* first = scene.colour(solid, 0, 0);
        for (double x = -11.9; x < 12.0; x += 0.3) {
            CAPTURE(x);
            if (std::abs(x) < radius - 0.2) CHECK(apart(scene.colour(solid, x, 0), first) <= 1);
        }
        // Where the rest of the ball reaches beyond the cap it is rounded, and lit otherwise.
        CHECK(apart(scene.colour(solid, 11.85, 0), first) > 20);
        CHECK(scene.empty(solid, 12.3, 0));
        scene.add_sphere(0.5F, {0, -4, 0}, 4.0); // glass within the ball
        CHECK(apart(scene.colour(scene.picture(), 0.05, 0), scene.colour(solid, 0.05, 0)) == 0);
        scene.frame.context.pop_back();
        // Glass: the front is gone, the back is seen.
        scene.frame.context[0].opacity = 0.5F;
        scene.frame.cut_away = CutAway{{0, 0, 0}, {0, 1, 0}};
        const Image open = scene.picture();
        CHECK_FALSE(scene.empty(open, 0, 0));
        scene.frame.cut_away = CutAway{{0, -12.5, 0}, {0, 1, 0}};
        CHECK(largest_difference(scene.picture(), scene.background) == 0);
    }
}

TEST_CASE("a cut is drawn by triangles while the view moves, too") {
    CutScene scene;
    scene.frame.cut_away = CutAway{{0, 0, 0}, {0, 1, 0}};
    (void)scene.draw();
    scene.frame.quality = Quality::kInteractive;
    scene.frame.camera = turned(scene.frame.camera, 3.0, 0.0);
    const DrawStatistics done = scene.draw();
    CHECK(done.cones == 0);
    CHECK(done.triangles > 0);
}
