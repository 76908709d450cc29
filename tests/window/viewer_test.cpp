// The window without a window: what it does where graphics memory runs out, and with several viewports.
#include "render/scene/camera_moves.h"
#include "tests/support/viewer_stage.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using render::GlVersion;
using test::ViewerStage;

namespace {

// The tree's part of a picture of the window: panels remember where the pointer was.
std::vector<std::uint8_t> view_of(const render::Image& image, const app::Layout& layout) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < layout.view_size.y; ++y) {
        const std::uint8_t* row = image.pixel(layout.view_at.x, layout.view_at.y + y);
        pixels.insert(pixels.end(), row, row + 4 * static_cast<std::ptrdiff_t>(layout.view_size.x));
    }
    return pixels;
}

// Three viewports beside each other: the mask, cones and the convolution surface of one vessel.
struct ComparedStage : ViewerStage {
    const app::Layout& layout = viewer->layout();

    ComparedStage() : ViewerStage("1 1 0 0 -20 6 -1\n2 1 0 0 20 6 1\n", {1100, 600}) {
        settle();
        run({"compare", "side-by-side", "iso,cones,cs"});
        settle();
        REQUIRE(layout.viewports_at.size() == 3);
    }
    void run(const std::vector<std::string>& words) const { REQUIRE(app::run_command(viewer->actions(), words)); }
    [[nodiscard]] glm::dvec2 middle(std::size_t viewport) const {
        return glm::dvec2(layout.view_at + layout.viewports_at[viewport]) + 0.5 * glm::dvec2(layout.viewport_size);
    }
    void point(glm::dvec2 at) const { viewer->input().mouse_moved(at); }
};

} // namespace

TEST_CASE("a viewer that runs out of graphics memory says so, lives, and shows the tree again" *
          doctest::test_suite("slow")) {
    for (const GlVersion version : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const glm::ivec2 size(900, 600);
        ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n", size, version);
        app::Viewer& viewer = *stage.viewer;
        const auto settle = [&] {
            stage.settle();
            stage.now += 10.0; // notices are gone
            viewer.redraw();
            for (int i = 0; i < 5; ++i) stage.draw();
            return view_of(stage.target.read_premultiplied(), viewer.layout());
        };
        const std::vector<std::uint8_t> before = settle();
        const glm::ivec2 middle = viewer.layout().view_at + viewer.layout().view_size / 2;

        render::limit_gl_allocation(200'000); // the interface fits, no picture does
        viewer.resize(size + 60, 1.0F);
        stage.draw();
        CHECK(viewer.interface().notice.text.find("out of graphics memory") != std::string::npos);
        viewer.input().mouse_moved(glm::dvec2(middle));
        for (int i = 0; i < 10; ++i) stage.draw();
        CHECK_FALSE(viewer.files().closing());
        viewer.input().mouse_left();

        render::limit_gl_allocation();
        viewer.resize(size, 1.0F);
        CHECK(settle() == before);
    }
}

TEST_CASE("next to the panel of a case that was just opened there is never the picture of the one before" *
          doctest::test_suite("slow")) {
    test::ViewerStage stage("1 3 0 0 0 8 -1\n2 3 0 0 20 8 1\n", {700, 500});
    const auto other = stage.folder.path() / "other.swc";
    std::ofstream(other) << "1 3 0 0 0 1 -1\n2 3 30 0 0 1 1\n";
    app::Viewer& viewer = *stage.viewer;
    stage.settle();
    viewer.files().use_settings({}); // a person's window: it draws while the surface is made
    const auto before = view_of(stage.settle(), viewer.layout());
    REQUIRE(app::run_command(viewer.actions(), std::vector<std::string>{"open", other.string()}));
    const auto is_open = [&] { return stage.workspace.document().session().tree.path == other; };
    for (int i = 0; i < 2000 && !(is_open() && viewer.resting()); ++i) {
        stage.draw();
        if (is_open()) REQUIRE(view_of(stage.target.read_premultiplied(), viewer.layout()) != before);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(is_open());
    stage.settle();
    CHECK(viewer.interface().preparing == app::Preparing::kNothing);
}

TEST_CASE("viewports beside each other show the tree, and each is pointed at by itself" * doctest::test_suite("slow")) {
    ComparedStage stage;
    CHECK(stage.viewer->picture().picture_size() == stage.layout.viewport_size);
    CHECK(3 * stage.layout.viewport_size.x < stage.layout.view_size.x);
    // The tree was fitted to the viewport: its middle is in the middle of each.
    const render::Image beside = stage.target.read_premultiplied();
    for (std::size_t viewport = 0; viewport < 3; ++viewport) {
        CAPTURE(viewport);
        const glm::ivec2 at(stage.middle(viewport));
        CHECK(beside.pixel(at.x, at.y)[0] > beside.pixel(at.x, at.y)[2] + 40); // vessels are red
        stage.point(stage.middle(viewport));
        stage.settle();
        CHECK(stage.viewer->interface().hovered == (viewport == 0 ? tree::kNoBranch : 0)); // a mask has no branches
    }
    // They share the bar, which is of what is pointed at, in whichever it is.
    stage.point(stage.middle(1));
    stage.settle();
    REQUIRE(stage.viewer->picture().scale_bar());
    CHECK(stage.viewer->picture().scale_bar()->at == render::Scale::At::kPointer);
    // The vessel of 6 mm lies along z, its wall is 6 mm before its middle.
    const render::Camera& camera = stage.workspace.document().session().camera;
    const double wall = mm_per_pixel_at(camera, stage.layout.viewport_size, camera.position.y - 6.0);
    const render::ScaleBar bar = *stage.viewer->picture().scale_bar();
    CHECK(bar.length_mm / bar.pixels == doctest::Approx(wall).epsilon(0.01));
    stage.viewer->input().mouse_left();
    stage.settle();
    CHECK(stage.viewer->picture().scale_bar()->at == render::Scale::At::kMiddle);
    // A click on the mask selects nothing, one on the cones the branch.
    for (const std::size_t viewport : {0U, 1U}) {
        stage.point(stage.middle(viewport));
        stage.button(true, 1.0);
        stage.button(false, 0.05);
        stage.settle();
        CHECK(stage.workspace.document().marks().selection.size() == viewport);
    }
    stage.run({"compare", "off"});
    stage.settle();
    CHECK(stage.layout.viewports_at.size() == 1);
    CHECK(stage.viewer->picture().picture_size() == stage.layout.view_size);
}

TEST_CASE("a drag in any of several viewports turns the one camera, as far in each" * doctest::test_suite("slow")) {
    ComparedStage stage;
    app::Document& document = stage.workspace.document();
    const render::Camera start = document.session().camera;
    std::vector<render::Camera> turned;
    for (std::size_t viewport = 0; viewport < 3; ++viewport) {
        document.set_camera(start);
        stage.point(stage.middle(viewport));
        stage.button(true, 1.0);
        stage.point(stage.middle(viewport) + glm::dvec2(30.0, 0.0));
        stage.draw();
        stage.point(stage.middle(viewport) + glm::dvec2(5.0, 500.0)); // out of it
        stage.button(false, 0.05);
        turned.push_back(document.session().camera);
        CHECK(turned.back() != start);
        // About what is under the pointer there, which is on another surface in each.
        const render::CameraAxes axes = axes_of(turned.back()), first = axes_of(turned.front());
        CHECK(glm::distance(axes.forward, first.forward) < 1e-9);
        CHECK(glm::distance(axes.up, first.up) < 1e-9);
        stage.settle();
    }
}
