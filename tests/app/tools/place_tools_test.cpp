// The tools that place lesions, cut and measure, driven as the mouse drives them.
#include "app/tools/place_tools.h"
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
                .pick_at = [this](glm::dvec2) { return under; }};
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
    CHECK(sphere_of(commands[0][1]) == std::array<double, 4>{0.0, 3.0, 20.0, LesionTool::kUsualRadiusMm});

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

TEST_CASE("beside the vessels a lesion lies at the depth of the focal point; Escape gives it up") {
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
    marks.lesions = {{0.0, 0.0, 30.0, 10.0}}; // 50 pixels around the middle of the picture
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

TEST_CASE("the measuring tools take one place or two") {
    ToolStage stage;
    stage.under = pick_of(0, {0, 3, 30});
    MeasureTool diameter(Measurement::Kind::kDiameter);
    diameter.press(stage.at(1, 1));
    CHECK(diameter.take_commands() == std::vector<CommandLine>{{"measure", "diameter", "0", "0.750"}});
    MeasureTool angle(Measurement::Kind::kAngle);
    angle.press(stage.at(1, 1));
    CHECK(angle.take_commands() == std::vector<CommandLine>{{"measure", "angle", "0"}});
    MeasureTool way(Measurement::Kind::kPath);
    MeasureTool distance(Measurement::Kind::kDistance);
    for (MeasureTool* tool : {&way, &distance}) {
        stage.under = pick_of(0, {0, 3, 30});
        tool->press(stage.at(1, 1));
        CHECK(tool->take_commands().empty());
        CHECK(tool->escape());
        tool->press(stage.at(1, 1));
        stage.under = pick_of(2, {-20, 2, 60});
        tool->press(stage.at(1, 1));
    }
    CHECK(way.take_commands() == std::vector<CommandLine>{{"measure", "path", "0", "2"}});
    CHECK(distance.take_commands() ==
          std::vector<CommandLine>{{"measure", "distance", "0.00,3.00,30.00", "-20.00,2.00,60.00"}});
}

TEST_CASE("the nearest fraction is where a place on the centerline lies") {
    const ToolStage stage;
    for (const double fraction : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        const auto place = measure::point_on(*stage.document.tree(), 0, fraction);
        CHECK(measure::nearest_fraction(*stage.document.tree(), 0, place.position) == doctest::Approx(fraction));
        CHECK(measure::nearest_fraction(*stage.document.tree(), 0, place.position + glm::dvec3(2, -1, 0)) ==
              doctest::Approx(fraction));
    }
}
