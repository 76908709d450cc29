// Lesions against what geometry says: before, inside and behind vessels and glass they veil and are veiled as reckoned
// by hand, in any order of triangles; they are picked as if they were opaque.
#include "tests/support/beside_scene.h"

#include <array>
#include <doctest/doctest.h>
#include <random>

using namespace ramus::render;
using namespace ramus::test;
using ramus::mesh::TriangleMesh;

namespace {

const ShapeLook kLook{{0.35F, 0.72F, 0.88F}, 0.45F};

enum class As : std::uint8_t { kSphere, kMesh };

void add_lesion(Frame& frame, As as, const glm::dvec3& centre, double radius) {
    if (as == As::kSphere)
        frame.lesions.spheres.emplace_back(centre, radius);
    else
        frame.lesions.meshes.push_back(std::make_shared<const TriangleMesh>(icosphere(6, centre, radius)));
}

void fill_background(Frame& frame, float grey) { frame.background = {glm::vec3(grey), glm::vec3(grey), false}; }

// The veil of a ball at a pixel's four samples, and that of none: by how far right and down from its middle it is, mm.
glm::dvec4 veil_of_ball(double radius, const glm::dvec2& mm) {
    glm::dvec4 mean(0.0);
    for (const glm::dvec2 sample : {glm::dvec2(-0.125, -0.375), {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}}) {
        const glm::dvec2 across = (mm + kPixelMm * sample) / radius;
        const double rest = 1.0 - glm::dot(across, across);
        if (rest > 0.0)
            mean += 0.25 * veil_of(kLook.colour, double(kLook.opacity), {across.x, -across.y, std::sqrt(rest)});
    }
    return mean;
}

struct Position {
    const char* name;
    glm::dvec3 centre;
    double radius;
};
constexpr std::array<Position, 3> kPositions{
    {{"before", {0, 30, 0}, 12.0}, {"inside", {0, 0, 0}, 4.0}, {"behind", {0, -30, 0}, 12.0}}};

} // namespace

TEST_CASE("a lesion before, inside and behind vessels and glass is laid over and under them as reckoned by hand" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const BranchState state : {BranchState::kNormal, BranchState::kDefocused}) {
            BesideScene scene(newest);
            scene.frame.states[0] = state;
            // What the tube lets through: with a lighter background there is that much more of it.
            constexpr float kGrey = 0.85F;
            fill_background(scene.frame, kGrey);
            const Image lighter = scene.picture();
            fill_background(scene.frame, 0.0F);
            const Image tube = scene.picture();
            for (const Position& at : kPositions)
                for (const As as : {As::kSphere, As::kMesh}) {
                    CAPTURE(newest.text());
                    CAPTURE(int(state));
                    CAPTURE(std::string(at.name));
                    CAPTURE(int(as));
                    scene.frame.lesions = {};
                    add_lesion(scene.frame, As::kSphere, {0, 500, 500}, 1.0); // out of the picture, in another colour
                    add_lesion(scene.frame, as, at.centre, at.radius);
                    scene.frame.lesions.looks = {{}, kLook};
                    const Image with = scene.picture();
                    int compared = 0;
                    double largest = 0.0;
                    for (int y = 3; y + 3 < scene.frame.size.y; y += 3)
                        for (int x = 3; x + 3 < scene.frame.size.x; x += 3) {
                            const glm::dvec2 mm =
                                kPixelMm * (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(scene.frame.size));
                            const double away = std::abs(mm.y) - kTube;
                            if (std::abs(glm::length(mm) - at.radius) < 0.3 || std::abs(away) < 0.3) continue;
                            if (std::abs(mm.x) > 20.0) continue; // the tube's round ends
                            const glm::dvec4 veil = veil_of_ball(at.radius, mm);
                            const double added = half_step(x, y, scene.frame.size.y);
                            const auto light = [&](const Image& image, int k) {
                                return decoded(double(image.pixel(x, y)[k]) - added);
                            };
                            for (int k = 0; k < 3; ++k) {
                                const double through =
                                    away > 0.0 ? 1.0 : (light(lighter, k) - light(tube, k)) / double(linear(kGrey));
                                const double reckoned = at.centre.y > 0.0 ? veil[k] + (1.0 - veil.w) * light(tube, k)
                                                                          : light(tube, k) + through * veil[k];
                                largest = std::max(largest,
                                                   std::abs(encoded(reckoned) + added - double(with.pixel(x, y)[k])));
                            }
                            ++compared;
                        }
                    CHECK(compared > 5000);
                    CHECK(largest <= 2.0);
                    MESSAGE(newest.text(), ", ", std::string(at.name), ", ", compared, " pixels: at most ", largest,
                            " of 255");
                }
        }
}

TEST_CASE("beyond the last margin a vessel looks as it does without margins, and within the first it does not" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        BesideScene scene(newest);
        scene.frame.colours = {{0.3F, 0.4F, 0.9F}};
        add_lesion(scene.frame, As::kSphere, {0, 500, 500}, 1.0); // out of the picture
        const Image plain = scene.picture();
        scene.frame.margins.bands = {{5.0F, {0.9F, 0.2F, 0.2F}}, {10.0F, {0.9F, 0.8F, 0.2F}}};
        CHECK(largest_difference(plain, scene.picture()) == 0);
        scene.frame.margins.bands.back().within_mm = 1000.0F;
        CHECK(largest_difference(plain, scene.picture()) > 50);
    }
}

TEST_CASE("a lesion close to the eye fills the picture to its corners, whatever triangles they cut" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const double eye : {10.5, 12.0, 14.0, 17.0}) {
            CAPTURE(newest.text());
            CAPTURE(eye);
            BesideScene scene(newest);
            scene.frame.states[0] = BranchState::kHidden;
            fill_background(scene.frame, 0.0F);
            scene.frame.camera.orthographic = false;
            scene.frame.camera.position = {0, eye, 0};
            add_lesion(scene.frame, As::kMesh, {0.2, 0, 0.1}, 10.0); // of triangles a fifth as large
            const Image fine = scene.picture();
            scene.frame.lesions = {};
            add_lesion(scene.frame, As::kSphere, {0.2, 0, 0.1}, 10.0);
            const Image sphere = scene.picture();
            const glm::ivec2 corner = scene.frame.size - 1;
            for (const glm::ivec2 at : {glm::ivec2(0), glm::ivec2(corner.x, 0), glm::ivec2(0, corner.y), corner})
                CHECK(fine.pixel(at.x, at.y)[0] > 100);
            CHECK(largest_difference(fine, sphere) <= 6);
        }
}

TEST_CASE("lesions are picked before, inside and behind glass, and hidden by opaque vessels and context" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const BranchState state : {BranchState::kNormal, BranchState::kDefocused})
            for (const Position& at : kPositions)
                for (const As as : {As::kSphere, As::kMesh}) {
                    CAPTURE(newest.text());
                    CAPTURE(int(state));
                    CAPTURE(std::string(at.name));
                    CAPTURE(int(as));
                    BesideScene scene(newest);
                    scene.frame.states[0] = state;
                    add_lesion(scene.frame, as, {100, 0, 0}, 1.0); // beside the picture: the first of two
                    add_lesion(scene.frame, as, at.centre, at.radius);
                    scene.add_sphere(0.3F, {0, 0, 0}, 60.0); // clear context around it all
                    (void)scene.draw();
                    const glm::ivec2 p = scene.at(0, 0);
                    const bool seen = state == BranchState::kDefocused || at.centre.y > 0.0;
                    const Pick pick = scene.pick(0, 0);
                    CHECK(pick.lesion == (seen ? 1 : kNoLesion));
                    CHECK(pick.branch == (seen ? kNoBranch : 0));
                    const double front = seen ? at.centre.y + at.radius : kTube;
                    CHECK(pick.position.y == doctest::Approx(front).epsilon(0.01));
                    CHECK(scene.renderer->read_branches().at(p.x, p.y) == (seen ? kNoBranch : 0));
                    CHECK(scene.pick(17, 0).branch == 0);
                    CHECK(scene.pick(17, 0).lesion == kNoLesion);
                    CHECK(scene.pick(0, 13).lesion == kNoLesion);
                    if (at.radius > kTube) CHECK(scene.pick(0, 9).lesion == 1);
                    scene.add_sphere(1.0F, {0, 60, 0}, 3.0); // opaque, before everything
                    (void)scene.draw();
                    CHECK(scene.pick(0, 0).lesion == kNoLesion);
                }
}

TEST_CASE("the order of triangles and of lesions makes no difference, nor does OpenGL's version" *
          doctest::test_suite("slow")) {
    std::vector<Image> versions;
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        BesideScene scene(newest);
        scene.frame.states[0] = BranchState::kDefocused;
        scene.frame.camera = turned(scene.frame.camera, 30.0, 20.0);
        add_lesion(scene.frame, As::kSphere, {8, 2, 1}, 7.0);
        add_lesion(scene.frame, As::kSphere, {-12, 2, 1}, 5.5);
        add_lesion(scene.frame, As::kMesh, {0, 0, 0}, 12.0);
        add_lesion(scene.frame, As::kMesh, {6, 3, 2}, 9.0);
        scene.add_sphere(0.4F, {-6, 3, 2}, 10.0);
        const Image before = scene.picture();
        std::mt19937 random(3);
        for (int round = 0; round < 2; ++round) {
            for (auto& lesion : scene.frame.lesions.meshes) {
                TriangleMesh mesh = *lesion;
                std::ranges::shuffle(mesh.triangles, random);
                lesion = std::make_shared<const TriangleMesh>(std::move(mesh));
            }
            std::ranges::reverse(scene.frame.lesions.meshes);
            std::ranges::reverse(scene.frame.lesions.spheres);
            CHECK(largest_difference(before, scene.picture()) <= 1);
        }
        versions.push_back(before);
    }
    CHECK(largest_difference(versions[0], versions[1]) <= 1);
}
