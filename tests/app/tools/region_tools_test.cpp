// The tools of the region of a scan: what clicks, drags and notches on slices ask for.
#include "app/tools/tool_kinds.h"
#include "tests/support/built_tree.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

struct RegionHand {
    explicit RegionHand(const char* name) : tool(find_tool(name)->make()) {
        document.open(
            std::make_shared<const tree::VesselTree>(test::built_tree({{{0, 0, 0}, 1.0}, {{0, 0, 9}, 1.0}}, {{0, 1}})),
            {});
    }
    // Axial, 0.5 mm a pixel, its middle at (0, 0, 7).
    [[nodiscard]] Pointing at(glm::dvec2 pixel, Modifiers modifiers = {}) const {
        SlicePointing on_slice;
        on_slice.grid = slice::grid_around(slice::axes_of(slice::Direction::kAxial), {0, 0, 7}, 0.5, {200, 100});
        return {.at = pixel,
                .modifiers = modifiers,
                .held = true,
                .size = {200, 100},
                .document = document,
                .settings = settings,
                .slice = on_slice};
    }
    Document document;
    ToolSettings settings;
    std::unique_ptr<Tool> tool;
};

} // namespace

TEST_CASE("a click on a slice begins a region there, and Shift adds a place") {
    RegionHand hand("region");
    CHECK(hand.tool->works_on() == WorksOn::kSlices);
    hand.tool->press(hand.at({120.0, 40.0})); // to the patient's left, and anterior
    CHECK(hand.tool->take_commands() == std::vector<CommandLine>{{"crosshair", "-10,5,7"}, {"region", "-10,5,7"}});
    Modifiers shift;
    shift.shift = true;
    hand.tool->press(hand.at({100.0, 50.0}, shift));
    CHECK(hand.tool->take_commands().back() == CommandLine{"region-add", "0,0,7"});
    Pointing beside = hand.at({100.0, 50.0});
    beside.slice.reset();
    hand.tool->press(beside); // on the tree
    CHECK(hand.tool->take_commands().empty());
    CHECK(hand.tool->step(1.0, hand.settings));
    CHECK(hand.tool->step(-1.0, hand.settings));
    CHECK(hand.tool->take_commands() == std::vector<CommandLine>{{"region-grow", "more"}, {"region-grow", "less"}});
}

TEST_CASE("a drag across a vessel cuts by a disc that stands on the slice, a click by a ball") {
    RegionHand hand("region-cut");
    hand.tool->press(hand.at({100.0, 50.0}));
    hand.tool->move(hand.at({120.0, 50.0}));
    CHECK(hand.tool->drawing(hand.at({120.0, 50.0})).lines.size() == 1);
    hand.tool->release(hand.at({120.0, 50.0}));
    const auto lines = hand.tool->take_commands();
    REQUIRE(lines.size() == 1);
    REQUIRE(lines[0].size() == 4);
    CHECK(lines[0][1] == "-5,0,7");                       // the middle of the line
    CHECK(lines[0][3] == "5");                            // half its length
    CHECK((lines[0][2].find("1,") != std::string::npos)); // across the line, on the slice
    hand.tool->press(hand.at({100.0, 50.0}));
    hand.tool->release(hand.at({101.0, 50.0}));
    CHECK(hand.tool->take_commands() == std::vector<CommandLine>{{"region-cut", "0,0,7", "3"}});
    hand.tool->press(hand.at({100.0, 50.0}));
    CHECK(hand.tool->escape());
    hand.tool->release(hand.at({120.0, 50.0}));
    CHECK(hand.tool->take_commands().empty());
    CHECK_FALSE(hand.tool->escape());
    CHECK(hand.tool->step(2.0, hand.settings));
    CHECK(hand.tool->take_commands().front()[0] == "region-radius");
}
