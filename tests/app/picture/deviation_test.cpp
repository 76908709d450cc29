// Colours by how far the surface lies from another one: what is measured, what the legend says of it, what commands and
// sessions keep, and that no colour outlives what it is of. Witness: a sphere in one that is 0.5 mm larger.
#include "app/picture/compose_sheet.h"
#include "app/picture/deviation_colours.h"
#include "app/session/session_file.h"
#include "app/workspace/deviation_maker.h"
#include "app/workspace/workspace.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"
#include "tests/support/icosphere.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using From = DeviationChoice::From;
using Unit = DeviationChoice::Unit;

namespace {

constexpr const char* kForkOfDeviation = "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";

// A tree whose surface is said to be a sphere of 10 mm, and a file with another around the same middle.
struct Spheres : test::CommandStage {
    static constexpr double kRadius = 10.0;
    static constexpr int kLevel = 5;
    // The larger sphere is one of triangles: its nearest point lies no deeper than their sagitta below 0.5 mm, and the
    // vertices, which lie on the same rays, reach 0.5.
    static constexpr double kSagitta = 0.003;
    TemporaryFolder folder;
    std::filesystem::path larger = folder.path() / "larger.ply";
    std::shared_ptr<const render::PagedMesh> sphere =
        std::make_shared<const render::PagedMesh>(test::icosphere(kLevel, glm::dvec3(0.0), kRadius));

    Spheres() : CommandStage(*io::parse_tree(kForkOfDeviation, "fork.swc")) {
        REQUIRE(io::write_mesh(test::icosphere(kLevel, glm::dvec3(0.0), kRadius + 0.5), larger));
        good("deviation-from " + larger.string());
    }
    void measure() {
        refresh(assets, document);
        Job job;
        auto made = make_deviation(deviation_of(document.tree(), marks(), marks().options), 0, 0, sphere, nullptr, job);
        REQUIRE_MESSAGE(made, made.error().message());
        assets.deviation = std::move(*made);
    }
    render::Frame frame() {
        refresh(assets, document);
        return compose(document.session(), assets, sphere, {.size = {400, 300}});
    }
};

} // namespace

TEST_CASE("a sphere inside a sphere that is 0.5 mm larger has a deviation of 0.5 mm everywhere, also in the legend") {
    Spheres stage;
    stage.measure();
    const SurfaceDeviation& found = stage.assets.deviation;
    for (const std::uint32_t vertex : stage.sphere->used_vertices()) {
        const auto& page = *found.valued_mesh->value_pages()[vertex / render::VertexPage::kSize];
        const float mm = page.values[vertex % render::VertexPage::kSize];
        CHECK(mm < 0.5F + 1e-4F);
        CHECK(mm > 0.5F - Spheres::kSagitta);
    }
    CHECK(found.mean_mm == doctest::Approx(0.5).epsilon(0.01));
    CHECK(found.most_mm == doctest::Approx(0.5).epsilon(1e-3));
    const render::Frame frame = stage.frame();
    CHECK(frame.mesh == found.valued_mesh);
    CHECK(frame.scale.value == render::ColourScale::Value::kSurface);
    CHECK(frame.scale.high == doctest::Approx(0.5));
    const render::Legend& legend = frame.overlays.legend;
    CHECK(legend.title == "Deviation (mm)");
    CHECK(legend.subtitle == "from larger.ply");
    CHECK(legend.ticks.front().text == "0");
    CHECK(legend.ticks.back().at == 1.0);
    CHECK(legend.ticks.back().text == "0.5"); // nothing lies beyond
    CHECK(legend.bar == frame.scale.ramp);
}

TEST_CASE("a colour scale ends at the given value, and its end shows whether larger values exist") {
    Spheres stage;
    stage.measure();
    stage.good("deviation-scale 0.25");
    CHECK(stage.frame().scale.high == 0.25F);
    CHECK(stage.frame().overlays.legend.ticks.back().text == "> 0.25");
    stage.good("deviation-scale 2 mm");
    CHECK(stage.frame().scale.high == 2.0F);
    CHECK(stage.frame().overlays.legend.ticks.back().text == "2");
    for (const auto& tick : stage.frame().overlays.legend.ticks)
        CHECK(tick.at == doctest::Approx(std::stod(tick.text) / 2.0));
    stage.good("deviation-scale auto");
    CHECK(stage.frame().scale.high == doctest::Approx(0.5));
    // As diagonals of voxels, where a mask has them.
    SurfaceDeviation of_mask = stage.assets.deviation;
    of_mask.voxel_mm = 0.25;
    const DeviationChoice voxels{From::kIsosurface, {}, Unit::kVoxels, 0.0};
    CHECK(scale_end(voxels, of_mask) == doctest::Approx(2.0));
    render::Frame frame;
    Marks marks;
    marks.deviation = {From::kIsosurface, {}, Unit::kVoxels, 1.0};
    show_deviation(frame, marks, &of_mask);
    CHECK(frame.scale.high == 0.25F);
    CHECK(frame.overlays.legend.title == "Deviation (voxel diagonals)");
    CHECK(frame.overlays.legend.subtitle == "from isosurface of the tree's voxels");
    CHECK(frame.overlays.legend.ticks.back().text == "> 1");
    // The same surface twice: a scale all the same.
    CHECK(scale_end({}, {}) > 0.0);
}

TEST_CASE("places without a measurement have no colour of the scale, and the legend shows it") {
    Spheres stage;
    const auto neutral = [](const render::Frame& frame) {
        return frame.scale.value == render::ColourScale::Value::kNone && frame.overlays.legend.bar.empty() &&
               frame.overlays.legend.swatches.size() == 1 && frame.overlays.legend.swatches[0].text == "not measured" &&
               std::ranges::all_of(frame.colours, [](const glm::vec3& c) { return c == kNotMeasuredColour; });
    };
    CHECK(neutral(stage.frame()));
    stage.measure();
    CHECK_FALSE(neutral(stage.frame()));
    const auto measured = stage.sphere;
    stage.sphere = std::make_shared<const render::PagedMesh>(test::icosphere(3, glm::dvec3(0.0), 9.0));
    CHECK(neutral(stage.frame())); // another surface
    stage.sphere = measured;
    stage.good("deviation-from cones");
    CHECK(neutral(stage.frame())); // from another one
    stage.good("undo");
    CHECK_FALSE(neutral(stage.frame()));
    // Cones know what is hidden and how they were made; a file does not.
    stage.good("deviation-from cones");
    const DeviationOf before = deviation_of(stage.document.tree(), stage.marks(), stage.marks().options);
    stage.good("select 2\nhide");
    CHECK(deviation_of(stage.document.tree(), stage.marks(), stage.marks().options) != before);
    stage.good("show-all\nsurface smooth 0");
    CHECK(deviation_of(stage.document.tree(), stage.marks(), stage.marks().options) != before);
}

TEST_CASE("commands set the other surface and the scale of a deviation, can be undone, and refuse invalid values") {
    Spheres stage;
    const Marks start = stage.marks();
    CHECK(start.colour_by == ColourBy::kDeviation);
    CHECK(start.deviation.from == From::kFile);
    CHECK(start.deviation.file == stage.larger.string());
    stage.good("deviation-from iso\ndeviation-scale 1.5 voxels");
    CHECK(stage.marks().deviation == DeviationChoice{From::kIsosurface, {}, Unit::kVoxels, 1.5});
    stage.good("deviation-from cones"); // which have no voxels
    CHECK(stage.marks().deviation == DeviationChoice{});
    stage.good("undo\nundo\nundo");
    CHECK(stage.marks() == start);
    for (const char* wrong : {"deviation-scale", "deviation-scale 0", "deviation-scale -1", "deviation-scale 1 cm",
                              "deviation-scale 1 mm mm", "deviation-scale auto voxels", "deviation-scale nan"})
        CHECK_FALSE(stage.bad(wrong).empty());
    CHECK(stage.bad("deviation-from nowhere.ply").find("no such file") != std::string::npos);
    CHECK(stage.bad("deviation-from").find("cones, iso or a file") != std::string::npos);
    CHECK(stage.bad("deviation-from cones iso").find("one surface") != std::string::npos);
    CHECK(stage.bad("deviation-from " + stage.folder.write("a.txt", "?").string()).find("neither") !=
          std::string::npos);
}

TEST_CASE("a session stores the other surface and the scale of a deviation, and is refused if they are invalid") {
    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "tree.swc";
    CHECK_FALSE(to_json(session, folder.path()).contains("deviation"));
    session.marks.colour_by = ColourBy::kDeviation;
    for (const DeviationChoice& choice :
         {DeviationChoice{From::kFile, (folder.path() / "other.ply").string(), Unit::kMm, 0.25},
          DeviationChoice{From::kIsosurface, {}, Unit::kVoxels, 0.0}, DeviationChoice{From::kCones, {}, Unit::kMm, 2.0},
          DeviationChoice{}}) {
        session.marks.deviation = choice;
        const auto read = session_from_json(to_json(session, folder.path()), folder.path(), "s.json");
        REQUIRE_MESSAGE(read, read.error().message());
        CHECK(read->session == session);
    }
    const auto refused = [&](const nlohmann::json& deviation) {
        auto value = to_json(session, folder.path());
        value["deviation"] = deviation;
        return !session_from_json(value, folder.path(), "s.json");
    };
    CHECK_FALSE(refused({{"from", "iso"}, {"unit", "voxels"}}));
    CHECK(refused({{"from", "cones"}, {"unit", "voxels"}}));
    CHECK(refused({{"from", "cs"}}));
    CHECK(refused({{"most", 0}}));
    CHECK(refused({{"unit", "cm"}}));
    CHECK(refused({{"colour", "red"}}));
}

TEST_CASE("a surface that cannot be computed is reported, and cancelled work ends") {
    Spheres stage;
    const auto made = [&](const DeviationOf& of, Job& job) {
        return make_deviation(of, 0, 0, stage.sphere, nullptr, job);
    };
    Job job;
    DeviationOf of = deviation_of(stage.document.tree(), stage.marks(), stage.marks().options);
    const auto far = stage.folder.path() / "far.ply";
    REQUIRE(io::write_mesh(test::icosphere(2, glm::dvec3(500.0, 0.0, 0.0), 5.0), far));
    of.file = far.string();
    REQUIRE_FALSE(made(of, job));
    CHECK(made(of, job).error().message().find("lies elsewhere") != std::string::npos);
    of.file = stage.folder.write("bad.ply", "ply\nnonsense").string();
    CHECK_FALSE(made(of, job));
    of.file = stage.larger.string();
    job.cancel();
    CHECK_FALSE(made(of, job));
}

TEST_CASE("distances are updated in the background with the surface, and keep their legend next to another surface") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", kForkOfDeviation));
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto change = [&](const auto& with) {
        Marks next = workspace.document().marks();
        with(next);
        workspace.document().change(std::move(next));
    };
    const auto measured = [&] {
        const Marks& marks = workspace.document().marks();
        return workspace.surface_ready() && !workspace.awaited(WorkKind::kDeviation) &&
               workspace.assets().deviation.fits(deviation_of(workspace.document().tree(), marks, marks.options),
                                                 workspace.shown().mesh);
    };
    const auto sheet = [&] {
        return compose_sheet(workspace.document().session(), workspace.current_assets(), workspace.surfaces(),
                             {.size = {600, 300}});
    };
    change([](Marks& marks) { marks.colour_by = ColourBy::kDeviation; });
    CHECK(workspace.awaited(WorkKind::kDeviation));
    CHECK(sheet().viewports[0].frame.overlays.legend.bar.empty());
    REQUIRE(test::settle(workspace, measured));
    CHECK(sheet().viewports[0].frame.overlays.legend.bar.size() > 0);
    const double whole = workspace.assets().deviation.most_mm;
    CHECK(whole > 0.0);
    CHECK(whole < 2.0); // a radius
    change([](Marks& marks) { set_state(marks, std::vector{1}, tree::BranchState::kHidden); });
    CHECK(sheet().viewports[0].frame.scale.value == render::ColourScale::Value::kNone); // the surface is another
    REQUIRE(test::settle(workspace, measured));
    CHECK(sheet().viewports[0].frame.scale.value == render::ColourScale::Value::kSurface);
    change([](Marks& marks) { marks.comparison.mode = Comparison::Mode::kSideBySide; });
    REQUIRE(test::settle(workspace, [&] { return !workspace.awaited(WorkKind::kComparison) && measured(); }));
    const render::Sheet both = sheet();
    REQUIRE(both.viewports.size() == 2);
    CHECK(both.viewports[0].frame.overlays.legend.bar.size() > 0);
    CHECK(both.viewports[1].frame.overlays.legend.title.empty());
    CHECK(both.viewports[1].frame.scale.value == render::ColourScale::Value::kNone); // these are not its distances
    // What cannot be read is said, and not tried for ever.
    change([&](Marks& marks) {
        marks.deviation.from = From::kFile;
        marks.deviation.file = (folder.path() / "none.ply").string();
    });
    REQUIRE(test::settle(workspace, [&] { return !workspace.assets().deviation.trouble.empty(); }));
    CHECK_FALSE(workspace.awaited(WorkKind::kDeviation));
    change([](Marks& marks) { marks.colour_by = ColourBy::kNothing; });
    workspace.update();
    CHECK(workspace.assets().deviation.mesh == nullptr);
}
