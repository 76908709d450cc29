// Resections and plans of a session, in volumes, margins, cut vessels and undo.
#include "app/assets/organ_text.h"
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
