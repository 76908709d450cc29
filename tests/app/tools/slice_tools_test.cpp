// Tools over a slice: places of the scan are measured, pinned, cut and divided as places of vessels are.
#include "app/tools/measure_tool.h"
#include "app/tools/resection_on_slice.h"
#include "app/tools/tool_kinds.h"
#include "render/slice/slice_view.h"
#include "tests/support/command_stage.h"
#include "tests/support/organ_stage.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;
using test::OrganStage;

namespace {

// An axial slice of 400 x 300 pixels of 0.1 mm through the middle of the organ.
struct SliceHand {
    explicit SliceHand(Document& of, double height = 0.0)
        : document(of),
          grid(slice::grid_around(slice::axes_of(slice::Direction::kAxial), {5.0, 0.0, height}, 0.1, {400, 300})) {}
    Document& document;
    ToolSettings settings;
    slice::PixelGrid grid;

    // The pointer over a place of the slice.
    [[nodiscard]] Pointing at(const glm::dvec3& place, bool held = false, int branch = tree::kNoBranch) const {
        render::Pick pick;
        pick.branch = branch;
        pick.position = place;
        return {.at = grid.pixel(place) + 0.5,
                .modifiers = {},
                .held = held,
                .size = grid.size,
                .document = document,
                .settings = settings,
                .under = pick,
                .slice = SlicePointing{grid, render::camera_of(grid), 0.5}};
    }
    void click(Tool& tool, const glm::dvec3& place) const {
        tool.move(at(place));
        tool.press(at(place, true));
        tool.release(at(place));
    }
    void drag(Tool& tool, const std::vector<glm::dvec3>& places) const {
        tool.move(at(places.front()));
        tool.press(at(places.front(), true));
        for (const glm::dvec3& place : places) tool.move(at(place, true));
        tool.release(at(places.back()));
    }
};

std::string words_of(Tool& tool) {
    std::string words;
    for (const CommandLine& line : tool.take_commands())
        for (const std::string& word : line) words += (words.empty() ? "" : " ") + word;
    return words;
}

} // namespace

TEST_CASE("a camera that looks at a slice projects places to the slice's pixels") {
    OrganStage stage;
    const SliceHand hand(stage.document, 2.0);
    const Pointing pointing = hand.at({1.25, -3.5, 2.0});
    for (const double depth : {0.0, 7.0}) { // whatever its height
        const auto pixel = render::project(pointing.camera(), pointing.size, {1.25, -3.5, 2.0 + depth});
        REQUIRE(pixel);
        CHECK(glm::distance(glm::dvec2(*pixel), pointing.at) < 1e-6);
    }
    CHECK(pointing.shows({9.0, 9.0, 2.4}));
    CHECK_FALSE(pointing.shows({9.0, 9.0, 2.6}));
}

TEST_CASE("a distance is measured between two places of a slice, and its ends are dragged there") {
    OrganStage stage;
    const SliceHand hand(stage.document);
    MeasureTool tool(Measurement::Kind::kDistance);
    CHECK(tool.works_on() == WorksOn::kBoth);
    hand.click(tool, {2.0, 1.0, 0.0});
    CHECK(tool.busy());
    tool.move(hand.at({6.0, 4.0, 0.0}));
    CHECK(tool.drawing(hand.at({6.0, 4.0, 0.0})).texts.at(0).text == "Distance 5.00 mm");
    hand.click(tool, {6.0, 4.0, 0.0});
    const std::string measured = words_of(tool);
    CHECK(measured == "measure distance 2,1,0 6,4,0");
    stage.good(measured);
    hand.drag(tool, {{6.0, 4.0, 0.0}, {8.0, 2.0, 0.0}, {10.0, 1.0, 0.0}});
    CHECK(words_of(tool) == "measure-change 1 distance 2,1,0 10,1,0");
    // On another slice the ends are neither shown nor grabbed.
    const SliceHand above(stage.document, 3.0);
    CHECK(tool.drawing(above.at({0.0, 0.0, 3.0})).circles.empty());
    above.drag(tool, {{6.0, 4.0, 3.0}, {8.0, 2.0, 3.0}});
    CHECK(words_of(tool) == "measure distance 6,4,3 8,2,3");
    // Other kinds of measurements want vessels.
    MeasureTool path(Measurement::Kind::kPath);
    hand.click(path, {2.0, 1.0, 0.0});
    CHECK_FALSE(path.busy());
}

TEST_CASE("pins are set and moved on slices") {
    OrganStage stage;
    const SliceHand hand(stage.document);
    const auto tool = find_tool("pin")->make();
    hand.click(*tool, {2.5, 1.0, 0.0});
    CHECK(words_of(*tool) == "pin 2.5,1,0");
    stage.good("pin 2.5,1,0 here\npin 9,1,4 above");
    hand.drag(*tool, {{2.5, 1.0, 0.0}, {4.0, 1.0, 0.0}, {5.0, 1.0, 0.0}});
    CHECK(words_of(*tool) == "pin-move 1 5,1,0");
    hand.click(*tool, {9.0, 1.0, 0.0}); // under the other pin
    CHECK(words_of(*tool) == "pin 9,1,0");
}

TEST_CASE("lines on a slice divide the organ across it, and sheets are led along other lines") {
    OrganStage stage;
    (void)stage.organ();
    const SliceHand hand(stage.document);
    const auto plane = find_tool("resect-plane")->make();
    hand.drag(*plane, {{4.0, -9.0, 0.0}, {5.0, 0.0, 0.0}, {6.0, 9.0, 0.0}});
    stage.good(words_of(*plane));
    const Resection cut = stage.marks().resections.at(0);
    REQUIRE(cut.kind == Resection::Kind::kPlane);
    CHECK(std::abs(cut.normal.z) < 1e-9);
    for (const glm::dvec3& at : {glm::dvec3(4, -9, 0), glm::dvec3(6, 9, 5)})
        CHECK(std::abs(glm::dot(at - cut.point, cut.normal)) < 1e-5);
    stage.good("object-remove resection 1");

    const auto sheet = find_tool("resect-sheet")->make();
    std::vector<glm::dvec3> stroke;
    for (int n = 0; n <= 20; ++n) stroke.emplace_back(5.0 + 0.05 * (n - 10), -12.0 + 1.2 * n, 0.0);
    hand.drag(*sheet, stroke);
    const std::string drawn = words_of(*sheet);
    CHECK(drawn.starts_with("resect along 0,0,-1 "));
    stage.good(drawn);
    const Resection before = stage.marks().resections.at(0);
    REQUIRE(before.kind == Resection::Kind::kSheet);
    for (const glm::dvec3& at : {glm::dvec3(4.8, -4.8, 0), glm::dvec3(5.2, 4.8, 4)})
        CHECK(std::abs(organ::height_above(before.sheet, at)) < 0.1);
    // Its line on the slice is grabbed, and a stroke from there corrects it.
    const auto hold = section_under(hand.at({5.2, 0.0, 0.0}), 10.0, true);
    REQUIRE(hold);
    CHECK(hold->pixels == doctest::Approx(2.0).epsilon(0.1));
    CHECK_FALSE(section_under(hand.at({9.0, 0.0, 0.0}), 10.0, true));
    CHECK_FALSE(section_lines(hand.at({9.0, 0.0, 0.0}), before, glm::vec4(1.0F)).empty());
    hand.drag(*sheet, {{5.0, 0.0, 0.0}, {6.0, 2.0, 0.0}, {7.0, 4.0, 0.0}});
    const std::string corrected = words_of(*sheet);
    CHECK(corrected.starts_with("resection-through 1 5,"));
    stage.good(corrected);
    CHECK(stage.last_step().starts_with("resection through 1 "));
    CHECK(std::abs(organ::height_above(stage.marks().resections.at(0).sheet, {7.0, 4.0, 0.0})) < 0.2);
    stage.good("undo");
    CHECK(stage.marks().resections.at(0) == before);

    const auto move = find_tool("resection")->make();
    hand.drag(*move, {{5.0, 0.0, 0.0}, {6.5, 0.0, 0.0}, {7.5, 0.5, 0.0}});
    CHECK(words_of(*move) == "resection-through 1 7.5,0.5,0");
    stage.good("resection-through 1 7.5,0.5,0");
    CHECK(std::abs(organ::height_above(stage.marks().resections.at(0).sheet, {7.5, 0.5, 0.0})) < 0.01);
}

TEST_CASE("commands of sheets on slices refuse what they cannot do") {
    OrganStage stage;
    (void)stage.organ();
    CHECK(stage.bad("resect along 0,0,0 1,2,3 4,5,6").find("direction") != std::string::npos);
    CHECK(stage.bad("resect along 0,0,1 1,2,3").find("direction") != std::string::npos);
    CHECK(stage.bad("resect along 0,0,1 1,2,3 word").find("word") != std::string::npos);
    CHECK(stage.bad("resect along 0,0,1 100,100,0 120,100,0").find("does not cross") != std::string::npos);
    stage.good("resect plane 5,0,0 1,0,0");
    CHECK(stage.bad("resection-through 1 1,2,3").find("no sheet") != std::string::npos);
    CHECK_FALSE(stage.bad("resection-through 2 1,2,3").empty());
    CHECK_FALSE(stage.bad("resection-through 1").empty());
}
