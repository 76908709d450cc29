// The import doctor in the window: it comes by itself when something could mislead, and outlives reading again.
#include "app/panels/doctor_panel.h"
#include "tests/support/viewer_stage.h"

#include <doctest/doctest.h>

using namespace ramus;
using test::ViewerStage;

namespace {

constexpr const char* kInCentimetres = "1 1 0 0 0 0.5 -1\n2 1 0 0 6 0.5 1\n3 1 2 0 9 0.3 2\n4 1 -2 0 9 0.3 2\n";

void run(ViewerStage& stage, const std::vector<std::string>& words) {
    REQUIRE(app::run_command(stage.viewer->actions(), words));
    stage.settle();
}

double thickest(const ViewerStage& stage) { return stage.workspace.document().facts()->statistics.radius_mm.max; }

} // namespace

TEST_CASE("the doctor's panel opens by itself when the unit is unlikely, not when all is plain" *
          doctest::test_suite("slow")) {
    {
        ViewerStage plain("1 1 0 0 -200 6 -1\n2 1 0 0 200 6 1\n", {900, 600});
        plain.settle();
        CHECK_FALSE(plain.viewer->interface().left_is<app::Doctor>());
    }
    ViewerStage odd(kInCentimetres, {900, 600}); // one window at a time
    odd.settle();
    CHECK(odd.viewer->interface().left_is<app::Doctor>());
    run(odd, {"doctor"});
    CHECK_FALSE(odd.viewer->interface().left_is<app::Doctor>());
}

TEST_CASE("reading again under the pointer leaves nothing of the tree before, and shows the other one" *
          doctest::test_suite("slow")) {
    ViewerStage stage(kInCentimetres, {900, 600});
    stage.settle();
    const auto& layout = stage.viewer->layout();
    stage.viewer->input().mouse_moved(glm::dvec2(layout.view_at) + 0.5 * glm::dvec2(layout.view_size));
    stage.settle();
    CHECK(thickest(stage) == 0.5);
    const double before = render::mm_per_pixel(stage.workspace.document().session().camera, layout.view_size);
    run(stage, {"read-as", "units", "cm"});
    CHECK(thickest(stage) == 5.0);
    CHECK(render::mm_per_pixel(stage.workspace.document().session().camera, layout.view_size) ==
          doctest::Approx(10.0 * before));
    CHECK(stage.viewer->interface().left_is<app::Doctor>());
    run(stage, {"undo"});
    CHECK(thickest(stage) == 0.5);
    CHECK(stage.viewer->interface().hovered < stage.workspace.document().branch_count());
}
