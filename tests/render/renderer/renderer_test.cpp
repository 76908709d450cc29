// Pictures of a small tree of capsules, drawn through OSMesa: what the eye expects of them, put into numbers.
#include "render/gl/gl_context.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/small_tree.h"
#include "tests/support/tube_mesh.h"

#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::SmallTree;

TEST_CASE("a picture is the same from draw to draw and from context to context") {
    Image first;
    {
        SmallTree scene;
        first = scene.draw();
        scene.frame.camera = turned(scene.frame.camera, 40.0, 10.0);
        CHECK(scene.draw() != first);
        scene.frame.camera = camera_for(scene.frame.mesh->positions(), View::kAnterior, scene.frame.size);
        CHECK(scene.draw() == first);
    }
    SmallTree scene;
    CHECK(scene.draw() == first);
}

TEST_CASE("nothing is drawn while nothing changes, and states draw no triangle again") {
    SmallTree scene;
    auto done = scene.renderer->draw(scene.frame).value();
    CHECK(done.uploaded > 0);
    CHECK(done.geometry);
    CHECK(done.triangles == scene.frame.mesh->triangle_count());
    done = scene.renderer->draw(scene.frame).value();
    CHECK_FALSE(done.shaded);
    scene.frame.hovered = 2;
    scene.frame.states[1] = BranchState::kHighlighted;
    scene.frame.selected = {0};
    done = scene.renderer->draw(scene.frame).value();
    CHECK(done.shaded);
    CHECK_FALSE(done.geometry);
    CHECK(done.uploaded == 0);
    scene.frame.camera = turned(scene.frame.camera, 1.0, 0.0);
    done = scene.renderer->draw(scene.frame).value();
    CHECK(done.geometry);
    CHECK(done.uploaded == 0);
    // Cached shading and a fresh renderer agree.
    const Image image = scene.renderer->read_image();
    SmallTree fresh;
    Frame frame = scene.frame;
    frame.mesh = fresh.frame.mesh;
    fresh.frame = frame;
    CHECK(fresh.draw() == image);
}

TEST_CASE("hidden branches leave neither picture nor pick, glass is seen through and picked through") {
    SmallTree scene;
    const Image all = scene.draw();
    const glm::dvec2 crossing = scene.pixel_of({0.0, 13.0, -12.0}), twig = scene.pixel_of({16.0, 12.0, -10.4});
    scene.frame.states[3] = BranchState::kDefocused;
    const Image with_glass = scene.draw();
    CHECK(scene.renderer->pick(crossing.x, crossing.y).branch == 0);
    CHECK(scene.renderer->pick(twig.x, twig.y).branch == 3);
    scene.frame.states[3] = BranchState::kHidden;
    const Image without = scene.draw();
    CHECK(scene.renderer->pick(crossing.x, crossing.y).branch == 0);
    CHECK(scene.renderer->pick(twig.x, twig.y).branch == kNoBranch);
    CHECK(scene.renderer->draw(scene.frame)->triangles == 0); // nothing changed
    const int tx = int(twig.x), ty = int(twig.y);
    CHECK(without.pixel(tx, ty)[0] < 40); // background
    CHECK(all.pixel(tx, ty)[0] > 100);
    CHECK(all.pixel(tx, ty)[0] > 2 * all.pixel(tx, ty)[2]); // red vessel
    // Glass: brighter than the background, greyer than the vessel.
    CHECK(with_glass.pixel(tx, ty)[0] > without.pixel(tx, ty)[0] + 10);
    CHECK(std::abs(with_glass.pixel(tx, ty)[0] - with_glass.pixel(tx, ty)[2]) < 40);
    // The trunk shows through it, still red.
    const std::uint8_t* through = with_glass.pixel(int(crossing.x), int(crossing.y));
    CHECK(through[0] > through[2] + 20);
}

TEST_CASE("hovering and highlighting touch the pixels of their branches only") {
    SmallTree scene;
    const Image before = scene.draw();
    // Which pixels show branch 2 at all: those that change when it goes (it hides nothing but background and joints).
    scene.frame.hovered = 2;
    const Image hovered = scene.draw();
    int changed = 0;
    for (int y = 0; y < before.height; ++y)
        for (int x = 0; x < before.width; ++x) {
            const bool same = std::equal(before.pixel(x, y), before.pixel(x, y) + 4, hovered.pixel(x, y));
            if (same) continue;
            ++changed;
            // A changed pixel shows the branch, or touches it (antialiasing).
            bool touches = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const Pick pick = scene.renderer->pick(x + 0.5 + dx, y + 0.5 + dy);
                    touches = touches || pick.branch == 2;
                }
            if (!touches) FAIL_CHECK("pixel ", x, ",", y, " changed without showing the branch");
        }
    CHECK(changed > 300);
    // What depends on a hovered branch glows, less than the branch itself.
    const glm::dvec2 on = scene.pixel_of({12.0, 8.0, 20.0});
    const auto light = [&](const Image& image) {
        const std::uint8_t* pixel = image.pixel(int(on.x), int(on.y));
        return pixel[0] + pixel[1] + pixel[2];
    };
    scene.frame.hovered = 0;
    scene.frame.hovered_dependents = {2};
    const Image depending = scene.draw();
    CHECK(light(depending) > light(before) + 5);
    CHECK(light(depending) < light(hovered) - 5);
    scene.frame.hovered_dependents.clear();
    // Highlighting makes the branch golden and leaves the empty background alone, while the rest goes calm.
    scene.frame.hovered = kNoBranch;
    scene.frame.states[2] = BranchState::kHighlighted;
    const Image highlighted = scene.draw();
    const glm::dvec2 arm = scene.pixel_of({12.0, 8.0, 20.0}), trunk = scene.pixel_of({0.0, 4.9, -25.0});
    const std::uint8_t* gold = highlighted.pixel(int(arm.x), int(arm.y));
    CHECK(gold[0] > 120);
    CHECK(gold[1] > 80);
    CHECK(gold[2] < gold[1] - 40);
    CHECK(highlighted.pixel(int(trunk.x), int(trunk.y))[0] < before.pixel(int(trunk.x), int(trunk.y))[0] - 30);
    CHECK(std::equal(before.pixel(3, 3), before.pixel(3, 3) + 4, highlighted.pixel(3, 3)));
}

TEST_CASE("a selection is outlined and tinted, and nothing else changes") {
    SmallTree scene;
    const Image before = scene.draw();
    scene.frame.selected = {1};
    const Image after = scene.draw();
    const glm::dvec2 arm = scene.pixel_of({-15.0, 0.0, 22.0}), trunk = scene.pixel_of({0.0, 4.9, -25.0});
    const std::uint8_t* p = after.pixel(int(arm.x), int(arm.y));
    CHECK(p[2] > p[0]); // bluish
    CHECK(std::equal(before.pixel(int(trunk.x), int(trunk.y)), before.pixel(int(trunk.x), int(trunk.y)) + 4,
                     after.pixel(int(trunk.x), int(trunk.y))));
    scene.frame.selected = {1, 999, -5}; // ids that no branch has
    CHECK(scene.draw() == after);
}

TEST_CASE("a transparent background has alpha 0, and the tree lies over any background as it was drawn") {
    SmallTree scene;
    const Image opaque = scene.draw();
    scene.frame.background.transparent = true;
    const Image clear = scene.draw();
    CHECK(clear.pixel(2, 2)[3] == 0);
    const glm::dvec2 trunk = scene.pixel_of({0.0, 4.9, -25.0});
    CHECK(clear.pixel(int(trunk.x), int(trunk.y))[3] == 255);
    int partial = 0, wrong = 0;
    for (int y = 0; y < clear.height; ++y)
        for (int x = 0; x < clear.width; ++x) {
            CHECK_MESSAGE(opaque.pixel(x, y)[3] == 255, "an opaque picture has no holes");
            const std::uint8_t* c = clear.pixel(x, y);
            if (c[3] == 255) wrong += std::abs(c[0] - opaque.pixel(x, y)[0]) > 1 ? 1 : 0;
            partial += c[3] > 0 && c[3] < 255 ? 1 : 0;
        }
    CHECK(partial > 200); // antialiased edges
    CHECK(wrong == 0);
}

TEST_CASE("occlusion darkens where vessels touch, and only there") {
    SmallTree scene({800, 600});
    scene.frame.appearance.occlusion = 0.0F;
    const Image without = scene.draw();
    scene.frame.appearance.occlusion = 1.0F;
    const Image with = scene.draw();
    int darker = 0, brighter = 0, surface = 0;
    for (std::size_t i = 0; i < with.rgba.size(); i += 4) {
        surface += without.rgba[i] > 60 ? 1 : 0;
        darker += with.rgba[i] + 4 < without.rgba[i] ? 1 : 0;
        brighter += with.rgba[i] > without.rgba[i] + 1 ? 1 : 0;
    }
    CHECK(darker > surface / 50);
    CHECK(darker < surface);
    CHECK(brighter == 0);
}

TEST_CASE("interactive quality shows the same tree") {
    SmallTree scene;
    const Image full = scene.draw();
    scene.frame.quality = Quality::kInteractive;
    const Image quick = scene.draw();
    CHECK(compare(full, quick, 60)->fraction() < 0.05);
    const glm::dvec2 trunk = scene.pixel_of({0.0, 4.9, -25.0});
    CHECK(scene.renderer->pick(trunk.x, trunk.y).branch == 0);
    scene.frame.quality = Quality::kFull;
    CHECK(scene.draw() == full);
}

TEST_CASE("presenting copies the picture, which itself stays untouched") {
    SmallTree scene;
    const Image image = scene.draw();
    PictureTarget target;
    target.make({scene.frame.size.x, scene.frame.size.y});
    scene.renderer->present(target.framebuffer, 0, 0, target.size);
    CHECK(target.read_premultiplied() == image);
    CHECK(scene.renderer->read_image() == image);
}

TEST_CASE("empty scenes, odd sizes and impossible ones" * doctest::test_suite("slow")) {
    SmallTree scene({1, 1});
    CHECK(scene.draw().width == 1);
    scene.frame.size = {333, 77};
    CHECK(scene.draw().height == 77);
    scene.frame.mesh = nullptr;
    const Image empty = scene.draw();
    CHECK(empty.pixel(150, 30)[0] < 40);
    CHECK(scene.renderer->pick(150, 30).branch == kNoBranch);
    scene.frame.mesh = std::make_shared<const PagedMesh>();
    CHECK(scene.draw() == empty);
    for (const glm::ivec2 size :
         {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(20000, 10), glm::ivec2(16000, 16000)}) {
        scene.frame.size = size;
        const auto done = scene.renderer->draw(scene.frame);
        REQUIRE_FALSE(done.has_value());
        CHECK_FALSE(done.error().hint.empty());
    }
    scene.frame.size = {333, 77};
    CHECK(scene.draw() == empty);
}

TEST_CASE("the small tree looks as it did when people last looked at it") {
    SmallTree scene({480, 360});
    scene.frame.overlays = {};
    scene.frame.states[2] = BranchState::kHighlighted;
    scene.frame.states[3] = BranchState::kDefocused;
    scene.frame.selected = {1};
    const Image image = scene.draw();
    const std::filesystem::path golden = std::filesystem::path(RAMUS_SOURCE_DIR) / "tests/golden/small_tree.png";
    const std::filesystem::path folder = std::filesystem::path(RAMUS_TEST_OUTPUT) / "golden";
    std::filesystem::create_directories(folder);
    if (std::getenv("RAMUS_UPDATE_GOLDEN") != nullptr) {
        std::filesystem::create_directories(golden.parent_path());
        REQUIRE(write_png(image, golden).has_value());
    }
    const auto reference = read_png(golden);
    REQUIRE_MESSAGE(reference.has_value(), "set RAMUS_UPDATE_GOLDEN=1 to make it, and look at it");
    const auto comparison = compare(image, *reference);
    REQUIRE(comparison.has_value());
    const bool alike = comparison->fraction() <= 0.001;
    if (!alike) {
        (void)write_png(image, folder / "small_tree.actual.png");
        (void)write_png(difference(image, *reference), folder / "small_tree.difference.png");
    }
    CHECK_MESSAGE(alike, comparison->differing, " pixels differ; see ", folder.string());
}

TEST_CASE("pointing elsewhere gives the very picture that drawing it all gives" * doctest::test_suite("slow")) {
    SmallTree scene, fresh;
    const auto same = [&](int hovered, std::vector<int> dependents) {
        scene.frame.hovered = hovered;
        scene.frame.hovered_dependents = std::move(dependents);
        Image onto_the_last = scene.draw();
        fresh.frame = scene.frame;
        fresh.frame.appearance.specular = 0.5F; // a picture that shares nothing with the next
        (void)fresh.draw();
        fresh.frame = scene.frame;
        CHECK(onto_the_last == fresh.draw());
        return onto_the_last;
    };
    const auto point_around = [&](int seen = 1) {
        const Image none = same(kNoBranch, {});
        CHECK_FALSE(same(seen, {}) == none);
        (void)same(0, {1, 2});
        (void)same(2, {});
        (void)same(3, {});
        CHECK(same(kNoBranch, {}) == none);
    };
    point_around();
    scene.frame.overlays.orientation_cube = scene.frame.overlays.scale_bar = true;
    point_around();
    scene.frame.camera = zoomed(scene.frame.camera, 4.0); // overlays lie over branches
    point_around(0);
    scene.frame.camera.position = {0.0, 8.0, 0.0}; // among them: parts are behind the eye
    point_around(0);
    scene.frame.camera = camera_for(scene.frame.mesh->positions(), View::kAnterior, scene.frame.size);
    scene.frame.quality = Quality::kInteractive;
    point_around();
    scene.frame.quality = Quality::kFull;
    scene.frame.selected = {0, 3}; // outlines reach beyond branches
    point_around();
    scene.frame.states[3] = BranchState::kDefocused; // glass before the trunk
    point_around();
    scene.frame.states[1] = BranchState::kHighlighted;
    scene.frame.states[2] = BranchState::kHidden;
    (void)same(1, {});
    CHECK(same(2, {}) == same(kNoBranch, {}));
}

TEST_CASE("a surface that graphics memory does not hold is seen by its preview") {
    const ramus::test::WatchedContext context;
    Frame frame;
    TriangleMesh fine, coarse;
    add_capsule(fine, {-20, 0, 0}, {20, 0, 0}, 6.0F, 3.0F, 0, 200);
    add_capsule(coarse, {-20, 0, 0}, {20, 0, 0}, 6.0F, 3.0F, 0, 16);
    frame.mesh = std::make_shared<const PagedMesh>(fine);
    frame.preview = std::make_shared<const PagedMesh>(coarse, frame.mesh->origin());
    frame.size = {200, 150};
    frame.camera = camera_for(frame.mesh->positions(), View::kAnterior, frame.size, false);
    const auto plenty = Renderer::create().value();
    const auto whole = plenty->draw(frame);
    REQUIRE(whole);
    CHECK_FALSE(whole->coarse);
    Frame of_preview = frame;
    of_preview.mesh = frame.preview;
    of_preview.preview = nullptr;
    REQUIRE(plenty->draw(of_preview));
    const Image expected = plenty->read_image();

    constexpr std::size_t kLittle = 400'000; // bytes: less than the 40,000 triangles, more than the preview
    const auto little = Renderer::create(kGlassBytes, kLittle).value();
    const auto drawn = little->draw(frame);
    REQUIRE_MESSAGE(drawn.has_value(), (drawn ? "" : drawn.error().message()));
    CHECK(drawn->coarse);
    CHECK(drawn->quality == Quality::kFull);
    CHECK_FALSE(drawn->pending);
    CHECK(little->read_image() == expected);
    CHECK(little->pick(100, 75).branch == 0);
    CHECK_FALSE(little->draw(frame)->shaded);

    frame.preview = nullptr;
    const auto refused = little->draw(frame);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("MB of graphics memory") != std::string::npos);
    CHECK(refused.error().hint.find("--graphics-memory") != std::string::npos);
    REQUIRE(little->draw(of_preview));
    CHECK(little->read_image() == expected);
}
