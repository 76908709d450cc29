// The tool for an oblique slice through three places.
#include "app/tools/three_places_tool.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

TEST_CASE("three clicks on vessels or slices put the oblique slice through them") {
    test::CommandStage stage(test::built_tree({{{0, 0, 0}, 2.0}, {{0, 0, 40}, 2.0}}, {{0, 1}}));
    const ToolSettings settings;
    const auto tool = make_slice_points_tool();
    const auto click = [&](const render::Pick& under, glm::dvec2 moved = {}) {
        Pointing pointing{.at = {10.0, 10.0}, .modifiers = {}, .document = stage.document, .settings = settings};
        pointing.under = under;
        tool->press(pointing);
        pointing.at += moved;
        tool->release(pointing);
    };
    const render::Pick vessel{.branch = 0, .position = {2, 0, 10}};
    const render::Pick slice{.position = {20, 0, 10}, .plane = 1};
    click(vessel);
    CHECK(tool->busy());
    CHECK(tool->escape()); // begins again
    CHECK_FALSE(tool->busy());
    click({});                  // nothing there
    click(vessel, {30.0, 0.0}); // a drag
    CHECK_FALSE(tool->busy());
    click(vessel);
    click(slice);
    CHECK(tool->take_commands().empty());
    CHECK(tool->hint().find("one more place") != std::string::npos);
    click({.position = {20, 10, 20}, .plane = 0});
    const auto lines = tool->take_commands();
    REQUIRE(lines.size() == 2);
    CHECK(lines[1] == CommandLine{"tool", "navigate"});
    CHECK_FALSE(tool->busy());
    stage.good(lines[0][0] + " " + lines[0][1] + " " + lines[0][2] + " " + lines[0][3]);
    const SliceViews& views = stage.document.session().slices;
    REQUIRE(views.crosshair);
    for (const glm::dvec3& place : {glm::dvec3(2, 0, 10), {20, 0, 10}, {20, 10, 20}})
        CHECK(glm::dot(place - *views.crosshair, views.oblique_normal) == doctest::Approx(0.0));
}
