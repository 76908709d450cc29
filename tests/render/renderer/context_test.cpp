// Context meshes against what geometry says: opaque ones hide and are hidden, clear ones veil what lies behind them as
// reckoned by hand, lines are as wide as they say. A tube along x of 5 mm radius and a sphere of 12 mm around its
// middle, seen from the front without perspective, 0.1 mm a pixel.
#include "render/gpu/gpu_shapes.h"
#include "tests/support/beside_scene.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <utility>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using namespace ramus::test;

using Scene = ramus::test::BesideScene;

TEST_CASE("an opaque context mesh hides vessels, glass and lines behind it, and is hidden by what lies before it" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const BranchState state : {BranchState::kNormal, BranchState::kDefocused}) {
            CAPTURE(newest.text());
            CAPTURE(int(state));
            Scene scene(newest);
            scene.frame.states[0] = BranchState::kHidden;
            scene.add_sphere(1.0F, {0, 30, 0}, 3.0);   // before the tube
            scene.add_sphere(1.0F, {15, -30, 0}, 3.0); // behind it
            const Image alone = scene.picture();
            CHECK(scene.pick(0, 0).branch == kNoBranch);
            scene.frame.states[0] = state;
            const Image both = scene.picture();
            const auto context = std::exchange(scene.frame.context, {});
            const Image tube = scene.picture();
            CHECK(apart(scene.colour(both, 0, 0), scene.colour(alone, 0, 0)) <= 1);
            CHECK(apart(scene.colour(both, 0, 0), scene.colour(tube, 0, 0)) > 30);
            CHECK(apart(scene.colour(both, -10, 0), scene.colour(tube, -10, 0)) <= 1);
            // Opaque vessels hide what is behind them, glass shows it.
            const bool hidden = apart(scene.colour(both, 15, 0), scene.colour(tube, 15, 0)) <= 1;
            CHECK(hidden == (state == BranchState::kNormal));
            scene.frame.context = context;
            (void)scene.draw();
            const Pick before = scene.pick(0, 0), behind = scene.pick(15, 0), beside = scene.pick(-10, 0);
            CHECK(before.branch == kNoBranch);
            CHECK(before.lesion == kNoLesion);
            CHECK(behind.branch == 0);
            CHECK(beside.branch == 0);
            const glm::ivec2 p = scene.at(0, 0);
            CHECK(scene.renderer->read_branches().at(p.x, p.y) == kNoBranch);
        }
}

TEST_CASE("who has no time sees large context a little later, and then as at once" * doctest::test_suite("slow")) {
    for (const float opacity : {1.0F, 0.5F})
        for (const bool lines : {false, true}) {
            CAPTURE(opacity);
            CAPTURE(lines);
            Scene scene;
            const Image without = scene.picture();
            scene.add_sphere(opacity); // 81,920 triangles
            scene.frame.context[0].wireframe = lines;
            const Image with = scene.picture();
            CHECK(with != without);

            const auto in_time = Renderer::create().value();
            Frame frame = scene.frame;
            const auto context = std::exchange(frame.context, {});
            REQUIRE(in_time->draw(frame));
            frame.context = context;
            constexpr std::size_t kBudget = 100'000; // bytes a call
            int calls = 0;
            std::uint64_t most = 0;
            for (bool more = true; more && calls < 100'000; ++calls) {
                const auto done = in_time->draw(frame, kBudget, 0.01);
                REQUIRE(done);
                most = std::max(most, done->uploaded);
                more = done->pending || done->unfinished;
                if (done->pending) CHECK(in_time->read_image() == without);
            }
            CHECK(most <= kBudget);
            CHECK(calls > 10);
            CHECK(in_time->read_image() == with);
        }
}

TEST_CASE("a large mesh beside the tree is drawn in parts, each of so many triangles at the most") {
    const WatchedContext context;
    const TriangleMesh mesh = icosphere(6, glm::dvec3(0.0), 10.0);
    Shape shape(Shape::make(mesh, Shape::As::kSurface));
    std::size_t all = std::numeric_limits<std::size_t>::max();
    CHECK(shape.send(all));
    std::uint64_t triangles = 0;
    for (std::size_t part = 0; part < shape.parts(); ++part) {
        const std::uint64_t of_part = shape.draw_part(part);
        CHECK(of_part <= Shape::kMostInPart);
        triangles += of_part;
    }
    CHECK(triangles == mesh.triangles.size());
}

TEST_CASE("a clear context mesh veils what lies behind it as reckoned by hand, and vessels are picked through it" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const BranchState state : {BranchState::kNormal, BranchState::kDefocused, BranchState::kHidden})
            for (const float opacity : {0.2F, 0.6F}) {
                CAPTURE(newest.text());
                CAPTURE(int(state));
                CAPTURE(opacity);
                Scene scene(newest);
                scene.frame.states[0] = state;
                const Image without = scene.picture();
                scene.add_sphere(opacity);
                const Image with = scene.picture();
                int compared = 0;
                double largest = 0.0;
                for (int y = 3; y + 3 < scene.frame.size.y; y += 3)
                    for (int x = 3; x + 3 < scene.frame.size.x; x += 3) {
                        // The picture's x is the patient's left: -x of the eye is +x of the patient.
                        const glm::dvec2 mm = kPixelMm * (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(scene.frame.size));
                        const double away = glm::length(mm),
                                     front = std::sqrt(std::max(0.0, kSphere * kSphere - away * away));
                        // Away from outlines, and from where the sphere goes through the tube.
                        const double tube = std::sqrt(std::max(0.0, kTube * kTube - mm.y * mm.y));
                        if (std::abs(away - kSphere) < 0.3 || std::abs(std::abs(mm.y) - kTube) < 0.3) continue;
                        const bool has_tube = std::abs(mm.y) < kTube && state != BranchState::kHidden;
                        if (has_tube && front < tube + 0.3) continue;
                        const double added = half_step(x, y, scene.frame.size.y);
                        for (int k = 0; k < 3; ++k) {
                            const double behind = decoded(double(without.pixel(x, y)[k]) - added);
                            double mean = behind;
                            if (away < kSphere) {
                                mean = 0.0;
                                for (const glm::dvec2 sample :
                                     {glm::dvec2(-0.125, -0.375), {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}}) {
                                    const glm::dvec2 position = mm + kPixelMm * sample;
                                    const glm::dvec2 across = position / kSphere;
                                    const glm::dvec3 normal(across.x, -across.y,
                                                            std::sqrt(std::max(0.0, 1.0 - glm::dot(across, across))));
                                    const glm::dvec4 veil = veil_of(kColour, double(opacity), normal);
                                    mean += 0.25 * (veil[k] + (1.0 - veil.w) * behind);
                                }
                            }
                            largest = std::max(largest, std::abs(encoded(mean) + added - double(with.pixel(x, y)[k])));
                        }
                        ++compared;
                    }
                CHECK(compared > 3000);
                CHECK(largest <= 2.0);
                MESSAGE(newest.text(), ", ", compared, " pixels: at most ", largest, " of 255 apart");
                const bool seen = state != BranchState::kHidden;
                CHECK(scene.pick(0, 0).branch == (seen ? 0 : kNoBranch));
                CHECK(scene.pick(0, 9).branch == kNoBranch);
                if (seen) CHECK(scene.pick(0, 0).position.y == doctest::Approx(kTube).epsilon(0.01));
            }
}

TEST_CASE("lines of triangles that reach beyond the picture are where they are, also where its corners cut them" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const bool flat : {true, false}) {
            CAPTURE(newest.text());
            CAPTURE(flat);
            Scene scene(newest);
            scene.frame.camera.orthographic = flat;
            scene.frame.camera.position = {30, 60, -20};
            scene.frame.background = {glm::vec3(0.0F), glm::vec3(0.0F), false};
            scene.frame.states[0] = BranchState::kHidden;
            const double most = 70.0, aside = flat ? -14.0 : -4.0; // the line between the two ends near a corner
            TriangleMesh square;
            square.positions = {{-most, 0, -most}, {most, 0, -most}, {most, 0, most}, {-most, 0, most}};
            for (glm::vec3& at : square.positions) at.x += static_cast<float>(aside);
            square.triangles = {{0, 1, 2}, {0, 2, 3}};
            scene.frame.context = {
                {std::make_shared<const TriangleMesh>(square), nullptr, glm::vec3(1.0F), 1.0F, true}};
            const Image lines = scene.picture();
            const auto on = [&](double at) {
                return glm::dvec2(*project(scene.frame.camera, scene.frame.size, {at + aside, 0.0, at}));
            };
            const glm::dvec2 from = on(-0.9 * most), way = glm::normalize(on(0.9 * most) - from);
            int beside = 0, on_line = 0, darkest = 255;
            for (int y = 0; y < lines.height; ++y)
                for (int x = 0; x < lines.width; ++x) {
                    const glm::dvec2 off = glm::dvec2(x + 0.5, y + 0.5) - from;
                    const double away = std::abs(off.x * way.y - off.y * way.x);
                    const int light = lines.pixel(x, y)[1];
                    if (away > 3.0) beside = std::max(beside, light);
                    if (away < 0.2) darkest = std::min(darkest, light), ++on_line;
                }
            CHECK(beside <= 1);
            CHECK(on_line > 50);
            CHECK(darkest > 150);
        }
}

TEST_CASE("the order of triangles and of meshes makes no difference to clear context" * doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        Scene scene(newest);
        scene.frame.states[0] = BranchState::kDefocused;
        scene.frame.camera = turned(scene.frame.camera, 30.0, 20.0);
        scene.add_sphere(0.3F);
        scene.add_sphere(0.5F, {6, 3, 2}, 9.0);
        scene.frame.context.back().colour = {0.3F, 0.6F, 0.9F};
        scene.add_sphere(1.0F, {-9, 3, 2}, 7.0);
        scene.frame.context.back().wireframe = true;
        const Image before = scene.picture();
        std::mt19937 random(3);
        for (int round = 0; round < 2; ++round) {
            for (ContextMesh& one : scene.frame.context) {
                TriangleMesh mesh = *one.mesh;
                std::ranges::shuffle(mesh.triangles, random);
                one.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
            }
            std::rotate(scene.frame.context.begin(), scene.frame.context.begin() + 1, scene.frame.context.end());
            CHECK(largest_difference(before, scene.picture()) <= 1);
        }
    }
}

TEST_CASE("lines are as wide as they say, hidden by what lies before them, and on both sides of an open mesh" *
          doctest::test_suite("slow")) {
    for (const GlVersion newest : {GlVersion{4, 5}, GlVersion{3, 3}})
        for (const float ratio : {1.0F, 2.0F})
            for (const bool turned_round : {false, true}) {
                CAPTURE(newest.text());
                CAPTURE(ratio);
                Scene scene(newest);
                scene.frame.pixel_ratio = ratio;
                scene.frame.background = {glm::vec3(0.0F), glm::vec3(0.0F), false};
                TriangleMesh square;
                square.positions = {{-12, 0, -12}, {12, 0, -12}, {12, 0, 12}, {-12, 0, 12}};
                square.triangles = {{0, 1, 2}, {0, 2, 3}};
                if (turned_round)
                    for (glm::uvec3& t : square.triangles) std::swap(t.y, t.z);
                scene.frame.context = {
                    {std::make_shared<const TriangleMesh>(square), nullptr, glm::vec3(1.0F), 1.0F, true}};
                scene.frame.states[0] = BranchState::kHidden;
                const Image lines = scene.picture();
                // Across the diagonal, from a row of pixels: sqrt(2) of its width, with light added up in linear light.
                const int row = scene.at(0, 7.0).y;
                const int crossing = scene.at(7.0, 7.0).x;
                double ink = 0.0;
                for (int x = crossing - 12; x <= crossing + 12; ++x)
                    ink += decoded(double(lines.pixel(x, row)[0]) - half_step(x, row, scene.frame.size.y)) /
                           decoded(encoded(1.0));
                CHECK(ink == doctest::Approx(std::sqrt(2.0) * 1.15 * ratio).epsilon(0.12));
                CHECK(lines.pixel(crossing - 25, row)[0] <= 1);
                // The tube's front hides them, and they are never pointed at.
                scene.frame.states[0] = BranchState::kNormal;
                const Image both = scene.picture();
                const auto context = std::exchange(scene.frame.context, {});
                const Image tube = scene.picture();
                CHECK(apart(scene.colour(both, 2.0, 2.0), scene.colour(tube, 2.0, 2.0)) <= 1);
                scene.frame.context = context;
                (void)scene.draw();
                CHECK(scene.pick(2.0, 2.0).branch == 0);
                CHECK(scene.pick(9.0, 9.0).branch == kNoBranch);
            }
}

TEST_CASE("an open context mesh is seen from behind as well, one that is inside out is turned" *
          doctest::test_suite("slow")) {
    Scene scene;
    scene.frame.states[0] = BranchState::kHidden;
    const Image nothing = scene.picture();
    TriangleMesh square;
    square.positions = {{-12, 0, -12}, {12, 0, -12}, {12, 0, 12}, {-12, 0, 12}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    std::vector<Image> sides;
    for (const float opacity : {0.5F, 1.0F})
        for (const View view : {View::kAnterior, View::kPosterior}) {
            scene.frame.camera = looking(scene.frame.camera, view);
            scene.frame.context = {{std::make_shared<const TriangleMesh>(square), nullptr, kColour, opacity, false}};
            const Image image = scene.picture();
            CHECK(apart(image.pixel(300, 150), nothing.pixel(300, 150)) > 30);
        }
    scene.frame.camera = looking(scene.frame.camera, View::kAnterior);
    for (const float opacity : {0.5F, 1.0F}) {
        const auto picture_of = [&](const TriangleMesh& ball) {
            scene.frame.context = {{std::make_shared<const TriangleMesh>(ball), nullptr, kColour, opacity, false}};
            return scene.picture();
        };
        const TriangleMesh ball = icosphere(4, {0, 0, 0}, 10.0);
        TriangleMesh bare = ball;
        bare.normals.clear();
        const Image right = picture_of(ball), right_bare = picture_of(bare);
        TriangleMesh turned = ball; // with normals that face outward all the same
        for (glm::uvec3& t : turned.triangles) std::swap(t.y, t.z);
        bare.triangles = turned.triangles;
        CHECK(largest_difference(right, picture_of(turned)) <= 1);
        CHECK(largest_difference(right_bare, picture_of(bare)) <= 1);
        for (glm::vec3& normal : turned.normals) normal = -normal;
        CHECK(largest_difference(right, picture_of(turned)) <= 1);
    }
}

TEST_CASE("another colour or opacity draws no triangles again, and context needs no tree" *
          doctest::test_suite("slow")) {
    Scene scene;
    scene.add_sphere(0.3F);
    CHECK(scene.draw().geometry);
    const Image before = scene.renderer->read_image();
    scene.frame.context[0].opacity = 0.7F;
    scene.frame.context[0].colour = {0.2F, 0.4F, 0.9F};
    CHECK_FALSE(scene.draw().geometry);
    CHECK(largest_difference(before, scene.renderer->read_image()) > 30);
    scene.frame.context[0].opacity = 1.0F; // no fragment any more
    CHECK(scene.draw().geometry);
    scene.frame.context[0].opacity = 0.0F;
    const Image gone = scene.picture();
    scene.frame.context.clear();
    CHECK(largest_difference(gone, scene.picture()) == 0);
    scene.frame.mesh = nullptr;
    const Image nothing = scene.picture();
    for (const float opacity : {0.4F, 1.0F}) {
        scene.frame.context.clear();
        scene.add_sphere(opacity);
        CHECK(apart(scene.colour(scene.picture(), 0, 0), scene.colour(nothing, 0, 0)) > 30);
    }
}

TEST_CASE("context stays while the view moves, cast along centerlines or, without them, drawn more coarsely" *
          doctest::test_suite("slow")) {
    for (const bool with_lines : {true, false}) {
        CAPTURE(with_lines);
        Scene scene;
        auto lines = std::make_shared<Centerlines>();
        lines->runs = {{0, 2}};
        lines->points = {{-20, 0, 0, 0}, {20, 0, 0, 40}};
        lines->details = {{float(2.0 * kTube), 0}, {float(2.0 * kTube), 0}};
        if (with_lines) scene.frame.centerlines = lines;
        scene.frame.beyond_ends = 1.0F; // as the capsule does
        scene.frame.preview = scene.frame.mesh;
        scene.add_sphere(0.5F, {0, 0, 9}, 5.0);
        scene.frame.context[0].preview = std::make_shared<const TriangleMesh>(icosphere(2, {0, 0, 9}, 5.0));
        (void)scene.draw();
        for (int turn = 0; turn < 3; ++turn) {
            scene.frame.quality = Quality::kInteractive;
            scene.frame.camera = turned(scene.frame.camera, 5.0, 0.0);
            CHECK(scene.draw().cones == (with_lines ? 1 : 0));
            const Image moving = scene.renderer->read_image();
            scene.frame.quality = Quality::kFull;
            const Image still = scene.picture();
            double sum = 0.0;
            for (std::size_t i = 0; i < still.rgba.size(); ++i) sum += std::abs(still.rgba[i] - moving.rgba[i]);
            CHECK(sum / double(still.rgba.size()) < (with_lines ? 0.2 : 1.0));
        }
    }
}
