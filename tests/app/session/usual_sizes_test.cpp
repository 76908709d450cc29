#include "app/session/carry_over.h"
#include "app/session/usual_sizes.h"
#include "tests/support/built_tree.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

tree::VesselTree vessel_of(double length_mm) {
    return test::built_tree({{{0.0, 0.0, 0.0}, 0.1 * length_mm}, {{length_mm, 0.0, 0.0}, 0.1 * length_mm}}, {{0, 1}});
}

} // namespace

TEST_CASE("default margins and limits fit a human organ, and are small round numbers for a mouse") {
    const Planning organ;
    CHECK(usual_sizes(vessel_of(180.0)).planning == organ);
    CHECK(usual_sizes(vessel_of(40.5)).planning == organ);
    CHECK(usual_sizes(vessel_of(180.0)).thin_mm == 2.0);
    CHECK(usual_sizes(tree::VesselTree()).planning == organ);
    const UsualSizes mouse = usual_sizes(vessel_of(24.0));
    REQUIRE(mouse.planning.bands_mm.size() == 3);
    CHECK(mouse.planning.bands_mm[0] == doctest::Approx(0.5));
    CHECK(mouse.planning.bands_mm[1] == doctest::Approx(1.0));
    CHECK(mouse.planning.bands_mm[2] == doctest::Approx(2.0));
    CHECK(mouse.planning.reconstruct_mm == doctest::Approx(0.5));
    CHECK(mouse.thin_mm == doctest::Approx(0.2));
}

TEST_CASE("default sizes follow the unit of the file, and chosen sizes are kept") {
    const tree::VesselTree in_cm = vessel_of(12.0), in_mm = vessel_of(120.0);
    Marks marks;
    marks.planning = usual_sizes(in_cm).planning;
    CHECK(carried_over(marks, BranchMap::read_again(in_cm, in_mm)).marks.planning == Planning());
    marks.planning.bands_mm = {3.0};
    CHECK(carried_over(marks, BranchMap::read_again(in_cm, in_mm)).marks.planning == marks.planning);
}
