// The tools that place lesions, cut and measure, driven as the mouse drives them.
#include "app/session/usual_sizes.h"
#include "app/tools/measure_tool.h"
#include "app/tools/place_tools.h"
#include "app/tools/tool_kinds.h"
#include "core/measure/branch_point.h"
#include "core/tree/build_tree.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

// Branch 0 runs from z = 0 to 40, its children to either side.
struct ToolStage {
    Document document;
    ToolSettings settings;
    render::Pick under; // what every pixel shows
    glm::ivec2 size{800, 600};

    ToolStage() {
        tree::Graph raw;
        raw.points = {{{0, 0, 0}, 3}, {{0, 0, 20}, 3}, {{0, 0, 40}, 3}, {{20, 0, 60}, 2}, {{-20, 0, 60}, 2}};
        raw.edges = {{0, 1}, {1, 2}, {2, 3}, {2, 4}};
        raw.roots = {0};
        auto tree = tree::build_tree(raw, tree::Repair::kNone, [](std::uint32_t) { return std::string(); });
        REQUIRE(tree);
        Session session;
        session.camera.position = {0, 200, 30};
        session.camera.focal_point = {0, 0, 30};
        session.camera.orthographic = true;
        session.camera.scale = 60.0; // mm for half the height: 0.2 mm a pixel
        document.open(std::make_shared<const tree::VesselTree>(std::move(*tree)), session);
    }
    Pointing at(double x, double y, bool held = false) {
        return {.at = {x, y},
                .modifiers = {},
                .held = held,
                .size = size,
                .document = document,
                .settings = settings,
                .under = under};
    }
};

render::Pick pick_of(int branch, const glm::dvec3& position) {
    render::Pick pick;
    pick.branch = branch;
    pick.position = position;
    return pick;
}

std::array<double, 4> sphere_of(const std::string& word) {
    std::array<double, 4> sphere{};
    REQUIRE(std::sscanf(word.c_str(), "%lf,%lf,%lf,%lf", &sphere[0], &sphere[1], &sphere[2], &sphere[3]) == 4);
    return sphere;
}

} // namespace

TEST_CASE("a click places a lesion of the usual size on the vessel, a drag sizes it") {
    ToolStage stage;
    LesionTool tool;
    stage.under = pick_of(0, {0, 3, 20});
    tool.press(stage.at(400, 300));
    tool.release(stage.at(400, 300));
    auto commands = tool.take_commands();
    REQUIRE(commands.size() == 1);
    CHECK(commands[0][0] == "lesion");
    CHECK(sphere_of(commands[0][1]) == std::array<double, 4>{0.0, 3.0, 20.0, 2.0}); // the tree is 72 mm from end to end

    // The picked place is at pixel (400, 350); 100 pixels beside it are 20 mm.
    tool.press(stage.at(400, 350));
    tool.move(stage.at(450, 350, true));
    tool.move(stage.at(500, 350, true));
    CHECK(tool.drawing(stage.at(500, 350, true)).circles.size() == 1);
    tool.release(stage.at(500, 350));
    commands = tool.take_commands();
    REQUIRE(commands.size() == 1);
    CHECK(sphere_of(commands[0][1])[3] == doctest::Approx(20.0).epsilon(1e-3));
}

TEST_CASE("a lesion's usual size is 20 mm in an organ, and less in a smaller tree, whatever its unit") {
    const auto usual_of = [](double mm) { // between the ends of the tree
        tree::Graph raw;
        raw.points = {{{0, 0, 0}, 0.02 * mm}, {{0, 0, mm}, 0.02 * mm}};
        raw.edges = {{0, 1}};
        raw.roots = {0};
        auto tree = tree::build_tree(raw, tree::Repair::kNone, [](std::uint32_t) { return std::string(); });
        REQUIRE(tree);
        return usual_sizes(*tree).lesion_radius_mm;
    };
    CHECK(usual_of(400.0) == 10.0);
    CHECK(usual_of(200.0) == 10.0);
    CHECK(usual_of(90.0) == 2.0);
    CHECK(usual_of(25.0) == doctest::Approx(1.0)); // the airways of a mouse
    CHECK(usual_of(0.05) == doctest::Approx(0.002));
}

TEST_CASE("away from vessels a lesion is placed at the depth of the focal point; Escape cancels") {
    ToolStage stage;
    LesionTool tool;
    tool.press(stage.at(300, 300));
    CHECK(tool.escape());
    CHECK_FALSE(tool.escape());
    tool.release(stage.at(300, 300));
    CHECK(tool.take_commands().empty());
    tool.press(stage.at(300, 300));
    tool.release(stage.at(300, 300));
    const auto commands = tool.take_commands();
    REQUIRE(commands.size() == 1);
    const auto sphere = sphere_of(commands[0][1]);
    // From the front the patient's right, positive x, is at the left of the picture.
    CHECK(std::abs(sphere[0]) == doctest::Approx(20.0).epsilon(1e-3));
    CHECK(sphere[1] == doctest::Approx(0.0));
    CHECK(sphere[2] == doctest::Approx(30.0));
}

TEST_CASE("a lesion is moved by its middle and sized by its outline") {
    ToolStage stage;
    Marks marks = stage.document.marks();
    marks.lesions = {{.sphere = {0.0, 0.0, 30.0, 10.0}}}; // 50 pixels around the middle of the picture
    stage.document.change(marks);
    LesionTool tool;
    tool.press(stage.at(405, 300));
    tool.move(stage.at(420, 300, true));
    tool.move(stage.at(455, 300, true));
    tool.release(stage.at(455, 300));
    auto commands = tool.take_commands();
    REQUIRE(commands.size() == 1);
    CHECK(commands[0][0] == "lesion-change");
    CHECK(commands[0][1] == "1");
    CHECK(std::abs(sphere_of(commands[0][2])[0]) == doctest::Approx(10.0).epsilon(1e-3));
    CHECK(sphere_of(commands[0][2])[3] == doctest::Approx(10.0));

    tool.press(stage.at(448, 300));
    tool.move(stage.at(475, 300, true));
    tool.release(stage.at(475, 300));
    commands = tool.take_commands();
    REQUIRE(commands.size() == 1);
    CHECK(sphere_of(commands[0][2])[0] == doctest::Approx(0.0));
    CHECK(sphere_of(commands[0][2])[3] == doctest::Approx(15.0).epsilon(1e-3));

    tool.press(stage.at(400, 300));
    tool.release(stage.at(400, 300));
    CHECK(tool.take_commands().empty()); // a click changes nothing
}

TEST_CASE("the cut tool cuts where the centerline is nearest") {
    ToolStage stage;
    CutTool tool;
    tool.press(stage.at(400, 300));
    CHECK(tool.take_commands().empty()); // nothing there
    stage.under = pick_of(0, {0, 3, 30});
    tool.move(stage.at(400, 300));
    CHECK(tool.drawing(stage.at(400, 300)).lines.size() == 1);
    tool.press(stage.at(400, 300));
    CHECK(tool.take_commands() == std::vector<CommandLine>{{"cut", "0", "0.750"}});
}

TEST_CASE("a cut is dragged along its branch, and Escape brings it back") {
    ToolStage stage;
    Marks marks = stage.document.marks();
    marks.cuts = {{0, 0.75}}; // at z = 30, in the middle of the picture
    stage.document.change(marks);
    CutTool tool;
    stage.under = pick_of(0, {0, 3, 30});
    tool.press(stage.at(403, 300));
    CHECK(tool.take_commands().empty());
    CHECK(tool.changes_while_held());
    stage.under = pick_of(0, {0, 3, 20});
    tool.move(stage.at(400, 350, true));
    CHECK(tool.take_commands() == std::vector<CommandLine>{{"cut-move", "1", "0.500"}});
    stage.under = pick_of(1, {10, 3, 50});
    tool.move(stage.at(450, 200, true)); // another branch
    CHECK(tool.take_commands().empty());
    CHECK(tool.escape());
    CHECK(tool.take_commands() == std::vector<CommandLine>{{"cut-move", "1", "0.750"}});
    CHECK_FALSE(tool.changes_while_held());
}

TEST_CASE("lines across the picture are commands of resections, and points of a plane are dragged along its normal") {
    ToolStage stage;
    const auto plane = find_tool("resect-plane")->make(), sheet = find_tool("resect-sheet")->make(),
               handles = find_tool("resection")->make();
    plane->press(stage.at(100, 100));
    plane->move(stage.at(200, 150, true));
    CHECK(plane->drawing(stage.at(200, 150)).lines.size() == 1);
    plane->release(stage.at(300, 200));
    CHECK(plane->take_commands() == std::vector<CommandLine>{{"resect", "line", "100.0,100.0", "300.0,200.0"}});
    sheet->press(stage.at(100, 100));
    for (int x = 110; x <= 300; x += 10) sheet->move(stage.at(x, 100 + (x % 40), true));
    sheet->release(stage.at(300, 120, true));
    const auto stroke = sheet->take_commands();
    REQUIRE(stroke.size() == 1);
    CHECK(stroke[0][1] == "stroke");
    CHECK(stroke[0].size() > 4);
    sheet->press(stage.at(100, 100));
    CHECK(sheet->escape());
    sheet->release(stage.at(300, 120));
    CHECK(sheet->take_commands().empty());

    Marks marks = stage.document.marks();
    marks.resections = {{.kind = Resection::Kind::kPlane, .point = {0, 0, 30}, .normal = {1, 0, 0}}};
    stage.document.change(marks);
    handles->press(stage.at(400, 300));
    REQUIRE(handles->changes_while_held());
    handles->move(stage.at(450, 300, true));
    const auto moved = handles->take_commands();
    REQUIRE(moved.size() == 1);
    CHECK(moved[0][0] == "resection-plane");
    glm::dvec3 at;
    REQUIRE(std::sscanf(moved[0][2].c_str(), "%lf,%lf,%lf", &at.x, &at.y, &at.z) == 3);
    CHECK(std::abs(at.x) == doctest::Approx(10.0)); // 50 pixels of 0.2 mm
    CHECK(at.z == doctest::Approx(30.0));
    handles->release(stage.at(450, 300));
    CHECK_FALSE(handles->changes_while_held());
}

TEST_CASE("the measuring tools use the clicked places, and preview the value") {
    ToolStage stage;
    stage.under = pick_of(0, {0, 3, 30});
    MeasureTool diameter(Measurement::Kind::kDiameter);
    diameter.move(stage.at(1, 1));
    CHECK(diameter.drawing(stage.at(1, 1)).texts.at(0).text == "Diameter 6.00 mm");
    diameter.press(stage.at(1, 1));
    diameter.release(stage.at(1, 1));
    CHECK(diameter.take_commands() == std::vector<CommandLine>{{"measure", "diameter", "0", "0.75000"}});
    MeasureTool path(Measurement::Kind::kPath);
    MeasureTool distance(Measurement::Kind::kDistance);
    for (MeasureTool* tool : {&path, &distance}) {
        stage.under = pick_of(0, {0, 3, 30});
        tool->press(stage.at(1, 1));
        tool->release(stage.at(1, 1));
        CHECK(tool->take_commands().empty());
        CHECK(tool->escape());
        tool->press(stage.at(1, 1));
        tool->release(stage.at(1, 1));
        stage.under = pick_of(2, {-20, 2, 60});
        tool->move(stage.at(90, 1));
        CHECK(tool->drawing(stage.at(90, 1)).texts.size() == 1);
        tool->press(stage.at(90, 1));
        tool->release(stage.at(90, 1));
    }
    CHECK(path.take_commands() == std::vector<CommandLine>{{"measure", "path", "0", "0.75000", "2", "1.00000"}});
    CHECK(distance.take_commands() == std::vector<CommandLine>{{"measure", "distance", "0,3,30", "-20,2,60"}});
    MeasureTool angle(Measurement::Kind::kAngle);
    for (const auto& pick : {pick_of(0, {0, 3, 30}), pick_of(0, {0, 3, 40}), pick_of(1, {20, 0, 60})}) {
        stage.under = pick;
        CHECK(angle.take_commands().empty());
        angle.press(stage.at(1, 1));
        angle.release(stage.at(1, 1));
    }
    CHECK(angle.take_commands() ==
          std::vector<CommandLine>{{"measure", "angle", "0", "0.75000", "0", "1.00000", "1", "1.00000"}});
}

TEST_CASE("a drag between two places measures, too; away from vessels it does nothing") {
    ToolStage stage;
    MeasureTool tool(Measurement::Kind::kDistance);
    tool.press(stage.at(10, 10));
    tool.release(stage.at(10, 10));
    CHECK_FALSE(tool.busy());
    stage.under = pick_of(0, {0, 3, 30});
    tool.press(stage.at(10, 10));
    stage.under = pick_of(0, {0, 3, 20});
    tool.move(stage.at(60, 10, true));
    CHECK(tool.drawing(stage.at(60, 10, true)).texts.at(0).text == "Distance 10.0 mm");
    tool.release(stage.at(60, 10));
    CHECK(tool.take_commands() == std::vector<CommandLine>{{"measure", "distance", "0,3,30", "0,3,20"}});
}

TEST_CASE("the distance tool snaps to lesions, and Shift takes the shortest distance") {
    ToolStage stage;
    Marks marks = stage.document.marks();
    marks.lesions = {{.sphere = {50.0, 0.0, 0.0, 1.0}}, {.sphere = {0.0, 0.0, 70.0, 10.0}}};
    stage.document.change(marks);
    const auto at = [&](double x, bool shift = false) {
        Pointing pointing = stage.at(x, 1);
        for (const Lesion& lesion : stage.document.marks().lesions)
            pointing.lesions.shapes.push_back({lesion, nullptr});
        pointing.modifiers.shift = shift;
        return pointing;
    };
    const auto click = [&](MeasureTool& tool, double x, const render::Pick& pick, bool shift = false) {
        stage.under = pick;
        tool.move(at(x));
        tool.press(at(x, shift));
        tool.release(at(x, shift));
    };
    render::Pick lesion;
    lesion.lesion = 1;
    lesion.position = {0.0, 9.9, 70.0}; // as a picture's depth has it: not quite on the surface
    MeasureTool tool(Measurement::Kind::kDistance);
    stage.under = lesion;
    tool.move(at(10));
    CHECK(tool.hint().find("lesion 2") != std::string::npos);
    CHECK(tool.drawing(at(10)).texts.at(0).text == "On lesion 2");
    click(tool, 10, lesion);
    CHECK(tool.take_commands().empty());
    click(tool, 90, pick_of(0, {0, 3, 40}));
    CHECK(tool.take_commands() == std::vector<CommandLine>{{"measure", "distance", "lesion:2@0,10,70", "0,3,40"}});

    for (const bool lesion_first : {true, false}) {
        CAPTURE(lesion_first);
        click(tool, lesion_first ? 10 : 90, lesion_first ? lesion : pick_of(0, {0, 3, 40}), lesion_first);
        if (lesion_first) {
            stage.under = pick_of(0, {0, 3, 20});
            tool.move(at(90));
            CHECK(tool.hint().find("shortest") != std::string::npos);
            CHECK(tool.drawing(at(90)).texts.at(0).text == "Shortest distance 17.0 mm"); // from z = 40 + 3 to 60
            CHECK(tool.drawing(at(90)).lines.size() == 1);
        }
        click(tool, lesion_first ? 90 : 10, lesion_first ? pick_of(0, {0, 3, 20}) : lesion, !lesion_first);
        CHECK(tool.take_commands() == std::vector<CommandLine>{{"measure", "distance", "lesion:2", "branch:0"}});
        CHECK_FALSE(tool.busy());
    }
    click(tool, 10, lesion, true); // from lesion to lesion there are two places
    click(tool, 90, lesion);
    CHECK(tool.take_commands().at(0).at(2) == "lesion:2@0,10,70");

    MeasureTool path(Measurement::Kind::kPath); // along vessels: a lesion is none
    click(path, 10, lesion);
    CHECK_FALSE(path.busy());
}

TEST_CASE("an end that lies on a lesion is dragged over it and away from it") {
    ToolStage stage;
    Marks marks = stage.document.marks();
    marks.lesions = {{.sphere = {0.0, 0.0, 70.0, 10.0}}};
    number_objects(marks);
    const int first = marks.lesions.front().id;
    marks.measurements = {{.points = {glm::dvec3(0, 10, 70), glm::dvec3(0, 3, 10)}, .lesions = {first, kNoObject}}};
    stage.document.change(marks);
    const auto at = [&](double x, double y, bool held) {
        Pointing pointing = stage.at(x, y, held);
        for (const Lesion& lesion : stage.document.marks().lesions)
            pointing.lesions.shapes.push_back({lesion, nullptr});
        return pointing;
    };
    const auto seen = render::project(stage.document.session().camera, stage.size, marks.measurements[0].points[0]);
    REQUIRE(seen);
    for (const bool onto_vessel : {false, true}) {
        MeasureTool tool(Measurement::Kind::kDistance);
        tool.press(at(seen->x, seen->y, true));
        stage.under = onto_vessel ? pick_of(0, {0, 3, 30}) : render::Pick{tree::kNoBranch, 0, {10, 0, 70}};
        tool.move(at(seen->x + 50, seen->y, true));
        tool.release(at(seen->x + 50, seen->y, false));
        const std::string end = onto_vessel ? "0,3,30" : "lesion:1@10,0,70";
        CHECK(tool.take_commands() == std::vector<CommandLine>{{"measure-change", "1", "distance", end, "0,3,10"}});
    }
}

TEST_CASE("dragging the end of a measurement previews the value, and is one command") {
    ToolStage stage;
    Marks marks = stage.document.marks();
    marks.measurements.push_back({.kind = Measurement::Kind::kPath, .places = {{{0, 0.25}, {0, 0.75}}}});
    stage.document.change(marks);
    // The places lie at z = 10 and 30 mm: 100 pixels below the middle of the picture, and in it.
    MeasureTool tool(Measurement::Kind::kAngle);
    tool.move(stage.at(403, 402));
    CHECK(tool.cursor() == Cursor::kHand);
    tool.press(stage.at(403, 402));
    CHECK_FALSE(tool.moved_measurement());
    stage.under = pick_of(0, {0, 3, 0});
    tool.move(stage.at(400, 450, true));
    CHECK(tool.moved_measurement() == 0);
    CHECK(tool.drawing(stage.at(400, 450, true)).texts.at(0).text == "Path 30.0 mm");
    tool.release(stage.at(400, 450));
    CHECK(tool.take_commands() ==
          std::vector<CommandLine>{{"measure-change", "1", "path", "0", "0.00000", "0", "0.75000"}});
    tool.press(stage.at(400, 300));
    tool.move(stage.at(400, 350, true));
    CHECK(tool.escape());
    tool.release(stage.at(400, 350));
    CHECK(tool.take_commands().empty());
    CHECK(tool.cursor() != Cursor::kHand);
}

TEST_CASE("undo during a drag releases the dragged object, and changes nothing else") {
    ToolStage stage;
    const Marks none = stage.document.marks();
    Marks both = none;
    both.measurements.push_back({.kind = Measurement::Kind::kPath, .places = {{{0, 0.25}, {0, 0.75}}}});
    both.lesions = {{.sphere = {0.0, 0.0, 30.0, 10.0}}};
    stage.under = pick_of(0, {0, 3, 0});
    for (const bool moves : {false, true}) {
        CAPTURE(moves);
        stage.document.change(both);
        MeasureTool measure(Measurement::Kind::kDistance);
        LesionTool lesion;
        measure.press(stage.at(400, 400));
        lesion.press(stage.at(405, 300));
        if (moves) measure.move(stage.at(400, 450, true)), lesion.move(stage.at(440, 300, true));
        stage.document.change(none);
        CHECK(measure.drawing(stage.at(400, 450, true)).circles.empty());
        measure.release(stage.at(400, 450)), lesion.release(stage.at(440, 300));
        CHECK(measure.take_commands().empty());
        CHECK(lesion.take_commands().empty());
        CHECK_FALSE(measure.busy());
    }
}

TEST_CASE("the nearest fraction of a place on the centerline is the place itself") {
    const ToolStage stage;
    for (const double fraction : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        const auto place = measure::point_on(*stage.document.tree(), 0, fraction);
        CHECK(measure::nearest_fraction(*stage.document.tree(), 0, place.position) == doctest::Approx(fraction));
        CHECK(measure::nearest_fraction(*stage.document.tree(), 0, place.position + glm::dvec3(2, -1, 0)) ==
              doctest::Approx(fraction));
    }
}
