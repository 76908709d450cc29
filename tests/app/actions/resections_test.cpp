// Resections and plans of a session, in volumes, margins, cut vessels, pictures, reports and undo.
#include "app/assets/organ_text.h"
#include "app/assets/territories.h"
#include "app/picture/compose_sheet.h"
#include "app/picture/flat_map.h"
#include "app/reports/table_kinds.h"
#include "app/session/session_file.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/organ_stage.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;
using test::kVoxels;
using test::OrganStage;

namespace {

constexpr double kSection = 20.0 * 12.0; // mm2, of the box across x, which extends from -8.5 to 17.5 mm
constexpr const char* kPlane = "resect plane 5,0,0 1,0,0";

} // namespace

TEST_CASE("a plane divides the organ, and its other side is the rest") {
    OrganStage stage;
    stage.good(kPlane);
    const auto operation = stage.operation();
    CHECK(operation->removed == doctest::Approx(12.5 * kSection));
    CHECK(operation->area_mm2 == doctest::Approx(kSection));
    stage.good("resection-flip 1");
    CHECK(stage.operation()->removed == doctest::Approx(13.5 * kSection));
    stage.good("resection-plane 1 0,0,0 1,0,0");
    CHECK(stage.operation()->removed == doctest::Approx(17.5 * kSection));
    stage.good("undo\nundo\nundo");
    CHECK(stage.operation()->removed == 0.0);
}

TEST_CASE("the vessels that a plane cuts are those whose centerlines pass it, and are in the table") {
    OrganStage stage;
    stage.good(kPlane);
    const auto operation = stage.operation();
    REQUIRE(operation->vessels.size() == 3);
    for (const organ::CutVessel& vessel : operation->vessels) {
        CHECK(vessel.place.fraction == doctest::Approx(0.5));
        CHECK(vessel.at.x == doctest::Approx(5.0));
        CHECK(vessel.diameter_mm == doctest::Approx(4.0));
        CHECK(vessel.in_organ);
        const double expected = vessel.place.branch == 3 ? 90.0 : 90.0 - std::atan2(8.0, 10.0) * 57.29577951308232;
        CHECK(vessel.angle_deg == doctest::Approx(expected));
    }
    const Table table = table_kind_named("cut-vessels")->table(stage.document, stage.assets);
    CHECK(table.rows.size() == 3);
}

TEST_CASE("the margin of a lesion is its distance from the cut") {
    OrganStage stage;
    stage.good("lesion 12,5,0,3");
    stage.good(kPlane);
    const auto margin = stage.operation()->margins.at(0);
    CHECK(margin.removed == organ::Removed::kWhole);
    CHECK(margin.distance_mm.value() == doctest::Approx(4.0).epsilon(0.001));
    stage.good("object-remove resection 1\nresect lesion 1 4");
    CHECK(stage.operation()->margins.at(0).distance_mm.value() == doctest::Approx(4.0).epsilon(0.001));
    stage.good("resection-margin 1 2");
    CHECK(stage.operation()->margins.at(0).distance_mm.value() == doctest::Approx(2.0).epsilon(0.001));
    const double ball = 4.0 / 3.0 * 3.14159265 * 125.0;
    CHECK(stage.operation()->removed == doctest::Approx(ball).epsilon(0.02));
    // A resection goes with its lesion.
    stage.good("lesion-remove 1");
    CHECK(stage.marks().resections.empty());
    stage.good("undo");
    CHECK(stage.marks().resections.size() == 1);
}

TEST_CASE("the margin of a lesion of a mask is measured from its voxels, as the file has them") {
    OrganStage stage;
    std::vector<std::uint8_t> voxels(kVoxels, 0);
    for (int x : {10, 11, 12})
        for (int y : {-1, 0, 1})
            for (int z : {0, 1}) voxels[static_cast<std::size_t>((x + 8) + 26 * (y + 10) + 26 * 20 * (z + 5))] = 1;
    test::NiftiFile file;
    file.dim = {3, 26, 20, 12, 1, 1, 1, 1};
    file.rows = {1, 0, 0, -8, 0, 1, 0, -10, 0, 0, 1, -5};
    file.put(voxels);
    const std::string mask = test::write_plain(stage.folder.path() / "lesion.nii", file.bytes()).string();
    stage.good("lesion-mask \"" + mask + "\"");
    CHECK(stage.operation()->functional == kVoxels - 18);
    stage.good(kPlane);
    CHECK(stage.operation()->margins.at(0).distance_mm.value() == doctest::Approx(9.5 - 5.0));
    stage.good("object-remove resection 1\nresect lesion 1 0");
    CHECK(stage.operation()->removed == doctest::Approx(18.0));
}

TEST_CASE("all that depends on cuts is removed, with a margin") {
    OrganStage stage;
    CHECK(stage.bad("resect cuts 0").find("no cuts") != std::string::npos);
    stage.good("cut 1 0\nresect cuts 0");
    const double lost = stage.operation()->removed;
    CHECK(lost == doctest::Approx(test::first_voxels()));
    stage.good("resection-margin 1 2");
    CHECK(stage.operation()->removed > lost + 2 * 18 * 12); // along the border of the two branches' halves
    CHECK(stage.operation()->removed < lost + 2 * 40 * 12);
}

TEST_CASE("a sheet through a contour and a mesh divide the organ as a plane does") {
    OrganStage stage;
    stage.good("resect sheet 5,-9,-5 5,9,-5 5,9,5 5,-9,5 5,0,5");
    const double removed = stage.operation()->removed;
    CHECK(removed == doctest::Approx(12.5 * kSection)); // the smaller side
    stage.good("resection-control 1 3 3 1");
    CHECK(std::abs(stage.operation()->removed - removed) > 1.0);
    CHECK(stage.bad("resection-control 1 99 0 1").find("by") != std::string::npos);
    stage.good("object-remove resection 1");

    auto ball = test::icosphere(4, {5, 0, 0}, 4.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    REQUIRE(io::write_mesh(ball, stage.folder.path() / "ball.stl", {}));
    (void)stage.organ();
    stage.good("resect surface \"" + (stage.folder.path() / "ball.stl").string() + "\"");
    CHECK(stage.operation()->removed == doctest::Approx(4.0 / 3.0 * 3.14159265 * 64.0).epsilon(0.02));
    stage.good("resection-flip 1");
    CHECK(stage.operation()->removed == doctest::Approx(kVoxels - 4.0 / 3.0 * 3.14159265 * 64.0).epsilon(0.02));
    CHECK(stage.bad("resect surface nowhere.stl").find("nowhere") != std::string::npos);
}

TEST_CASE("a line and a stroke across the picture divide the organ behind them") {
    OrganStage stage;
    const std::vector<glm::vec3> corners{{-8, -10, -5}, {17, 9, 6}};
    stage.document.set_camera(render::camera_for(corners, render::View::kSuperior, stage.host.picture_size()));
    (void)stage.organ();
    stage.good("resect line 200,20 200,280");
    const Resection plane = stage.marks().resections.at(0);
    CHECK(std::abs(glm::dot(plane.normal, render::axes_of(stage.document.session().camera).forward)) < 1e-9);
    CHECK(stage.operation()->removed > 0.0);
    CHECK(stage.operation()->removed <= 0.5 * kVoxels + 1.0); // the smaller side
    stage.good("object-remove resection 1\nresect stroke 200,1 205,80 195,160 200,299");
    REQUIRE(stage.marks().resections.at(0).kind == Resection::Kind::kSheet);
    CHECK(stage.operation()->removed > 0.2 * kVoxels);
    CHECK(stage.operation()->removed <= 0.5 * kVoxels + 1.0);
    CHECK(stage.bad("resect stroke -500,0 -400,0 -450,9").find("does not cross") != std::string::npos);
    // The side of a lesion goes, be it the larger one.
    for (const char* side : {"10,5,0,1", "-7,5,0,1"}) {
        stage.good("lesion-clear\nobject-remove resection 1");
        stage.good(std::string("lesion ") + side);
        stage.good("resect line 200,20 200,280");
        CHECK(stage.operation()->margins.at(0).removed == organ::Removed::kWhole);
    }
}

TEST_CASE("plans are copied, used, named and removed, and each keeps its own operation") {
    OrganStage stage;
    const Marks before = stage.marks();
    stage.good(kPlane);
    stage.good("plan-copy");
    CHECK(stage.marks().plans.name == "B");
    stage.good("resection-flip 1\ncut 2 0.5");
    CHECK(stage.operation(0)->removed == doctest::Approx(12.5 * kSection));
    CHECK(stage.operation(1)->removed == doctest::Approx(13.5 * kSection));
    stage.good("plan-use A");
    CHECK(stage.marks().cuts.empty());
    CHECK(stage.marks().plans.place == 0);
    stage.good("plan-name 1 \"left first\"");
    CHECK(all_plans(stage.marks())[0].name == "left first");
    CHECK(stage.operation(1)->removed == doctest::Approx(13.5 * kSection));
    const Table table = table_kind_named("organ")->table(stage.document, stage.assets);
    CHECK(table.rows.front().front().text == "left first");
    CHECK(table.rows.back().front().text == "B");

    const auto read = session_from_json(to_json(stage.document.session(), "/data"), "/data", "s.json");
    REQUIRE(read);
    CHECK(read->session.marks.plans == stage.marks().plans);
    CHECK(read->session.marks.resections == stage.marks().resections);

    stage.good("plan-remove 1");
    CHECK(stage.marks().plans.name == "B");
    CHECK(stage.marks().cuts.size() == 1);
    CHECK(stage.bad("plan-remove B").find("only plan") != std::string::npos);
    while (stage.document.can_undo() && stage.marks() != before) stage.good("undo");
    CHECK(stage.marks() == before);
}

TEST_CASE("commands of resections refuse what they cannot do") {
    OrganStage stage;
    for (const char* line :
         {"resect", "resect knife", "resect plane 1,2,3", "resect plane 1,2,3 0,0,0", "resect sheet 1,2,3 2,3,4 x",
          "resect sheet 0,0,0 1,0,0 2,0,0", "resect lesion 1 5", "resect cuts", "resect line 1,2", "resection-flip 1",
          "plan-use 7", "plan-name A", "resect surface"})
        stage.bad(line);
    stage.good("lesion 0,0,0,2\nresect lesion 1 5");
    CHECK(stage.bad("resection-flip 1").find("no other side") != std::string::npos);
    stage.bad("resection-margin 1 -2");
    stage.bad("resection-plane 1 0,0,0 1,0,0");
    stage.good("organ-clear");
    CHECK(stage.bad("resect lesion 1 5").find("organ FILE") != std::string::npos);
}

TEST_CASE("a plane goes through three points, or along the border of a territory, as a sheet does") {
    OrganStage stage;
    (void)stage.organ();
    stage.good("resect points 5,0,0 5,3,0 5,0,4");
    CHECK(stage.operation()->removed == doctest::Approx(12.5 * kSection)); // the smaller side
    CHECK(stage.bad("resect points 0,0,0 1,1,1 2,2,2").find("one line") != std::string::npos);
    stage.good("object-remove resection 1\nlesion 2,5,0,1\nresect points 5,0,0 5,3,0 5,0,4");
    CHECK(stage.operation()->removed == doctest::Approx(13.5 * kSection)); // the lesion's
    stage.good("object-remove resection 1\nterritories off");
    CHECK(stage.bad("resect border plane S1").find("no territories") != std::string::npos);

    stage.good("name 1 S1\nname 2 S2\nterritories names");
    (void)stage.organ();
    CHECK(stage.bad("resect border plane S7").find("no territory S7") != std::string::npos);
    CHECK(stage.bad("resect border S1").find("plane or sheet") != std::string::npos);
    for (const char* kind : {"plane", "sheet"}) {
        stage.good(std::string("resect border ") + kind + " S1");
        // The border lies at y = 0.5, between voxels; ties belong to branch 1.
        CHECK(stage.operation()->removed == doctest::Approx(test::first_voxels()).epsilon(0.02));
        stage.good("object-remove resection 1");
    }
}

TEST_CASE("plans side by side keep their places as one of them is used or removed") {
    OrganStage stage;
    stage.good(kPlane);
    CHECK(stage.bad("plan-compare A").find("current plan") != std::string::npos);
    stage.good("plan-copy\nresection-flip 1\nplan-compare A\nterritories remnant");
    const std::vector<Viewport> viewports = viewports_of(Session{{}, stage.marks(), {}, {}}, {800, 400}, 1.0F);
    REQUIRE(viewports.size() == 2);
    CHECK(viewports[0].title == "Plan A");
    CHECK(viewports[1].title == "Plan B, current");
    CHECK(viewports[1].plan == 1);
    const auto& assets = stage.organ();
    REQUIRE(assets.territories);
    REQUIRE(assets.compared);
    CHECK(assets.territories->of.operation == stage.operation(1));
    CHECK(assets.compared->of.operation == stage.operation(0));

    // Each viewport shows the surfaces of its own plan.
    const render::Sheet sheet = compose_sheet(stage.document.session(), stage.assets, {}, {.size = {800, 400}});
    const auto shows = [&](std::size_t viewport, const std::shared_ptr<const mesh::TriangleMesh>& mesh) {
        return std::ranges::count(sheet.viewports[viewport].frame.context, mesh, &render::ContextMesh::mesh);
    };
    for (std::size_t plan : {0U, 1U}) {
        CHECK(shows(plan, stage.operation(plan)->surfaces[0][0]) == 1);
        CHECK(shows(1 - plan, stage.operation(plan)->surfaces[0][0]) == 0);
        CHECK(shows(plan, (plan == 0 ? assets.compared : assets.territories)->parts[0].mesh) == 1);
    }

    const auto read = session_from_json(to_json(stage.document.session(), "/data"), "/data", "s.json");
    REQUIRE(read);
    CHECK(read->session.marks.plans == stage.marks().plans);
    stage.good("plan-use A");
    CHECK(stage.marks().plans.compared == 1); // both stay in the picture
    stage.good("plan-copy\nplan-use A\nplan-compare C\nplan-remove B");
    CHECK(stage.marks().plans.compared == 1);
    stage.good("plan-remove C");
    CHECK(!stage.marks().plans.compared);
    CHECK(!stage.organ().compared);
    stage.good("plan-copy\nplan-compare A\ncompare side-by-side");
    CHECK(!stage.marks().plans.compared); // the viewports are for surfaces
    stage.good("plan-compare A");
    CHECK(stage.marks().comparison.mode == Comparison::Mode::kOff);
}

TEST_CASE("the flat map of a plane has its area, its bands, its vessels and the place of the margin") {
    OrganStage stage;
    stage.good("lesion 12,5,0,3\nbands 5 10");
    stage.good("resect lesion 1 2");
    CHECK(!flat_map_of(*stage.operation(), 0, stage.marks())); // no plane
    stage.good("object-remove resection 1");
    stage.good(kPlane);
    const auto operation = stage.operation();
    const auto map = flat_map_of(*operation, 0, stage.marks());
    REQUIRE(map);
    REQUIRE(map->bands.size() == 3);
    CHECK(map->bands[1].distance == "5 to 10");
    double area = 0.0, near = 0.0;
    for (const FlatMap::Band& band : map->bands)
        for (const auto& [a, b, c] : band.triangles) {
            const double part = 0.5 * std::abs(double((b - a).x) * (c - a).y - double((b - a).y) * (c - a).x);
            area += part;
            if (&band == map->bands.data()) near += part;
        }
    CHECK(area == doctest::Approx(operation->area_mm2).epsilon(1e-4));
    // Within 5 mm of a sphere whose surface is 4 mm away: a disc, which the box does not cut.
    CHECK(near == doctest::Approx(3.14159265 * (64.0 - 49.0)).epsilon(0.05));
    // Removed is what lies at larger x, where the eye is: y grows to the right, z upward.
    CHECK(map->box.size().x == doctest::Approx(20.0));
    CHECK(map->box.size().y == doctest::Approx(12.0));
    CHECK(map->sides == std::array<std::size_t, 4>{3, 2, 5, 4});
    REQUIRE(map->vessels.size() == 3);
    for (const FlatMap::Vessel& vessel : map->vessels) CHECK(vessel.radius_mm == doctest::Approx(2.0));
    REQUIRE(map->nearest.size() == 1);
    CHECK(map->nearest[0].margin_mm == doctest::Approx(4.0).epsilon(0.001));
    CHECK(map->nearest[0].at.x == doctest::Approx(5.0).epsilon(0.02));
}

TEST_CASE("margins are drawn as lines, and the colours of their bands are explained") {
    OrganStage stage;
    stage.good("lesion 12,5,0,3");
    stage.good(kPlane);
    (void)stage.organ();
    const auto labels = [&] {
        const render::Frame frame = compose(stage.document.session(), stage.assets, {}, {});
        return std::pair(std::ranges::count(frame.labels, "margin 4.00 mm", &render::MarkLabel::text),
                         frame.overlays.legend.title.find("o lesion (mm)") != std::string::npos);
    };
    CHECK(labels() == std::pair{std::ptrdiff_t{1}, true});
    stage.good("object-hide resection 1");
    CHECK(labels() == std::pair{std::ptrdiff_t{0}, false});
}

TEST_CASE("a report has a page for each plan, with pictures before and after, and one that compares them") {
    OrganStage stage;
    stage.good("lesion 12,5,0,3");
    stage.good(kPlane);
    stage.good("plan-copy\nresection-flip 1\nterritories systems");
    (void)stage.organ();
    const auto file = stage.folder.path() / "report.html";
    stage.good("report \"" + file.string() + "\"");
    const std::string page = stage.folder.text("report.html");
    for (const char* words : {">Plan A<", ">Plan B<", "alt=\"Before\"", "alt=\"After\"", "Cut surfaces, laid flat",
                              "Vessels that are cut", "Organ and operation", "Estimated by distance"})
        CHECK_MESSAGE(page.find(words) != std::string::npos, words);
    // As many as there are plans, before and after, with one camera.
    std::vector<std::size_t> plans;
    std::vector<TerritoriesOf> territories;
    for (const Marks& marks : stage.host.drawn_marks)
        if (marks.organ.territories != stage.marks().organ.territories) {
            plans.push_back(marks.plans.place);
            territories.push_back(marks.organ.territories);
        }
    CHECK(plans == std::vector<std::size_t>{0, 0, 1, 1});
    CHECK(territories ==
          std::vector{TerritoriesOf::kOrgan, TerritoriesOf::kRemnant, TerritoriesOf::kOrgan, TerritoriesOf::kRemnant});
    CHECK(stage.host.cameras.back() == stage.host.cameras[stage.host.cameras.size() - 4]);
    CHECK(stage.marks().plans.place == 1); // nothing changed
}
