// The vessel that slices follow: its commands, the place in all views, sections and stenosis of a vessel with a known
// waist, the session, and edits of the tree.
#include "app/picture/along_picture.h"
#include "app/picture/compose_sheet.h"
#include "app/picture/slices.h"
#include "app/reports/section_tables.h"
#include "app/session/session_file.h"
#include "tests/core/slice/swept_tube.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

using namespace ramus;
using namespace ramus::app;

namespace {

// The radius of the vessel: 4 mm, with a waist of 2 mm in the middle that is a cone on either side.
double waist_radius(double z) { return std::min(4.0, 2.0 + 0.2 * std::abs(z - 30.0)); }

// A vessel along z from 0 to 60, and its surface.
struct AlongStage : test::CommandStage {
    AlongStage() : CommandStage(test::vessel_of([](double t) { return glm::dvec3(20.0, 15.0, 60.0 * t); }, 61, 4.0)) {
        constexpr int kAround = 256;
        const auto mesh = test::swept_tube(
            [](double t, double angle) {
                const double z = 60.0 * t;
                return glm::dvec3(20.0 + waist_radius(z) * std::cos(angle), 15.0 + waist_radius(z) * std::sin(angle),
                                  z);
            },
            241, kAround);
        mesh::TriangleMesh whole = mesh;
        const std::size_t own = whole.positions.size();
        // Another vessel reaches into it.
        test::join(whole, test::straight_tube({22.0, 15.0, 2.0}, {22.0, 15.0, 9.0}, {1.0, 1.0}, 32));
        const std::size_t count = whole.positions.size();
        whole.branches.assign(count, 0);
        std::fill(whole.branches.begin() + static_cast<std::ptrdiff_t>(own), whole.branches.end(), 1);
        whole.normals.assign(count, glm::vec3(0.0F, 0.0F, 1.0F));
        whole.radii.assign(count, 4.0F);
        whole.dominance.assign(count, {});
        host.mesh = std::make_shared<const render::PagedMesh>(whole);
    }
    [[nodiscard]] const SliceViews& views() const { return document.session().slices; }
    [[nodiscard]] const AlongVessel& along() const { return *views().along; }
    std::vector<std::string> lines_of(const std::filesystem::path& file) {
        std::ifstream stream(file);
        std::vector<std::string> lines;
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
        return lines;
    }
    TemporaryFolder folder;
};

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
}

} // namespace

TEST_CASE("slices follow a vessel: crosshair and oblique slice are at the place, across the vessel") {
    AlongStage stage;
    const std::size_t steps = stage.document.step_count();
    stage.good("along 0");
    CHECK(stage.along().at_mm == doctest::Approx(30.0));
    stage.good("along-at 12.5");
    CHECK(glm::distance(*stage.views().crosshair, glm::dvec3(20.0, 15.0, 12.5)) < 1e-6);
    CHECK(std::abs(stage.views().oblique_normal.z) == doctest::Approx(1.0));
    const slice::Axes axes = axes_of(stage.views(), slice::Direction::kOblique);
    CHECK(glm::distance(axes.right, *stage.views().oblique_right) < 1e-12);
    CHECK(glm::distance(axes.to_viewer(), stage.views().oblique_normal) < 1e-12);
    // Beyond the ends there is no vessel.
    stage.good("along-at 100");
    CHECK(stage.along().at_mm == doctest::Approx(60.0));
    stage.good("along-step 3");
    CHECK(stage.along().at_mm == doctest::Approx(60.0));
    // A step is one voxel: without a scan two steps of the path.
    stage.good("along-at 20\nalong-step -2");
    CHECK(stage.along().at_mm == doctest::Approx(20.0 - 4.0 * stage.assets.followed.path->step_mm));
    // The wheel over the oblique slice goes along the vessel as well.
    stage.good("along-at 20\nslice-step oblique 1");
    CHECK(stage.along().at_mm > 20.0);
    CHECK(stage.document.step_count() == steps); // nothing to undo
    stage.good("along off");
    CHECK_FALSE(stage.views().along);
}

TEST_CASE("another normal of the oblique slice drops the right of the vessel's pictures") {
    AlongStage stage;
    stage.good("along 0\nslice-through 0,0,0 10,0,0 0,10,10");
    const slice::Axes axes = axes_of(stage.views(), slice::Direction::kOblique);
    CHECK(std::abs(glm::dot(axes.right, stage.views().oblique_normal)) < 1e-9);
    CHECK(std::abs(glm::dot(axes.to_viewer(), stage.views().oblique_normal)) == doctest::Approx(1.0));
}

TEST_CASE("a stenosis is measured against a place, a stretch or a diameter") {
    AlongStage stage;
    stage.good("along 0");
    // The waist has half of the diameter and a quarter of the area.
    const std::string by_place = stage.good("stenosis 15 45 --reference 10");
    CHECK(by_place.find("Least diameter 50") != std::string::npos);
    CHECK(by_place.find("area 75") != std::string::npos);
    const auto places = narrow_places(*stage.assets.sections, *stage.along().stenosis);
    REQUIRE(places);
    CHECK(places->found.least_diameter.percent == doctest::Approx(50.0).epsilon(0.01));
    CHECK(places->found.area.percent == doctest::Approx(75.0).epsilon(0.01));
    CHECK(stage.assets.followed.path->samples[places->found.area.sample].arc_mm == doctest::Approx(30.0).epsilon(0.02));
    stage.good("stenosis 45 15 --diameter 10");
    const auto by_diameter = narrow_places(*stage.assets.sections, *stage.along().stenosis);
    REQUIRE(by_diameter);
    CHECK(by_diameter->found.least_diameter.percent == doctest::Approx(60.0).epsilon(0.01));
    stage.good("stenosis 15 45 --reference 5..12");
    CHECK(stage.along().stenosis->reference == Stretch{5.0, 12.0});
    const Table table = stenosis_table(stage.document, stage.assets);
    REQUIRE(table.rows.size() == 3);
    CHECK(*table.rows[0][1].number == doctest::Approx(50.0).epsilon(0.01));
    // Without a reference the stretch is only marked.
    CHECK(stage.good("stenosis 15 45").empty());
    CHECK_FALSE(has_stenosis(stage.document, stage.assets));
    stage.good("stenosis off");
    CHECK_FALSE(stage.along().stenosis);
}

TEST_CASE("a table of sections has the figures of the surface") {
    AlongStage stage;
    const auto file = stage.folder.path() / "sections.csv";
    stage.good("along 0\nsections " + file.string() + " --step 5");
    const auto lines = stage.lines_of(file);
    REQUIRE(lines.size() == 14); // a heading, and 0 to 60 mm
    const auto names = fields_of(lines[0]);
    const auto column = [&](const char* name) {
        return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    for (std::size_t n = 2; n + 1 < lines.size(); ++n) { // ends are flat caps
        const auto row = fields_of(lines[n]);
        const double arc = std::stod(row[column("arc")]);
        CHECK(arc == doctest::Approx(5.0 * static_cast<double>(n - 1)));
        const double radius = waist_radius(arc);
        CHECK(std::stod(row[column("area")]) == doctest::Approx(test::kPi * radius * radius).epsilon(0.005));
        CHECK(std::stod(row[column("least_diameter")]) == doctest::Approx(2.0 * radius).epsilon(0.005));
        CHECK(row[column("closed")] == "yes");
    }
}

TEST_CASE("ways, places and stenoses that are none are refused, and change nothing") {
    AlongStage stage;
    for (const char* line : {"along", "along 7", "along root", "along 0..", "along 0@0.5..0@0.5", "along-at 3",
                             "along-step 1", "along-show stretched", "stenosis 1 2", "sections a.csv"}) {
        CAPTURE(line);
        CHECK_FALSE(stage.bad(line).empty());
        CHECK_FALSE(stage.views().along);
    }
    stage.good("along 0");
    const SliceViews before = stage.views();
    for (const char* line :
         {"along 7", "along-at", "along-at x", "along-step", "along-show bent", "along-show --degrees 999",
          "along-show --width 0", "stenosis", "stenosis 1", "stenosis 1 99", "stenosis 1 2 --reference 99",
          "stenosis 1 2 --diameter 0", "stenosis 1 2 --colour 3", "sections a.txt", "sections a.csv --step 0"}) {
        CAPTURE(line);
        CHECK_FALSE(stage.bad(line).empty());
        CHECK(stage.views() == before);
    }
}

TEST_CASE("a session keeps the vessel that slices follow") {
    AlongStage stage;
    stage.good("along 0@0.1..0@0.9\nalong-at 7.25\nalong-show stretched --degrees 30 --width 25\n"
               "stenosis 10 30 --reference 2..5\nlayout along");
    const Session& session = stage.document.session();
    const auto read = session_from_json(to_json(session, "/data"), "/data", "s.json");
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message()));
    CHECK(read->session.slices == session.slices);
    stage.good("stenosis 10 30 --diameter 6.5\nalong-show straightened --width auto");
    const auto again = session_from_json(to_json(session, "/data"), "/data", "s.json");
    REQUIRE(again);
    CHECK(again->session.slices == session.slices);
}

TEST_CASE("the layout along a vessel has its picture, in which a pixel is a place of the vessel") {
    AlongStage stage;
    stage.good("along 0\nlayout along\nalong-at 20");
    stage.current_assets();
    const auto parts = viewports_of(stage.document.session(), {900, 600}, 1.0F);
    REQUIRE(parts.size() == 3);
    CHECK(parts[1].slice == slice::Direction::kOblique);
    CHECK(parts[2].along);
    for (const char* kind : {"straightened", "stretched"}) {
        stage.good(std::string("along-show ") + kind);
        const render::SliceView view =
            compose_along(stage.document.session(), stage.assets, stage.host.mesh, {.size = {400, 600}}, 20);
        REQUIRE(view.along);
        REQUIRE(view.along->path);
        for (const double arc : {0.0, 12.5, 33.0, 60.0}) {
            const glm::dvec2 pixel =
                view.along->pixel(slice::pixel_of(view.along->reformation(), *view.along->path, arc));
            const auto place = view.along->place_at(pixel);
            REQUIRE(place);
            CHECK(place->arc_mm == doctest::Approx(arc).epsilon(0.001));
            CHECK(glm::distance(place->at, glm::dvec3(20.0, 15.0, arc)) < 0.05);
            CHECK(pixel.y > 20.0);
            CHECK(pixel.y < 600.0);
        }
    }
}

TEST_CASE("walls of stretched pictures from a surface in pages are those of its sections") {
    AlongStage stage;
    stage.good("along 0\nstenosis 10 50 --diameter 8"); // measures sections
    const slice::VesselPath& path = *stage.assets.followed.path;
    const auto picture = slice::reformation_along(path, slice::ReformationKind::kStraightened, 20.0, 30.0);
    const Lumens& lumens = stage.assets.sections->lumens;
    const auto branches = render::branches_around(lumens, *stage.host.mesh);
    CHECK(branches == std::vector<char>{1, 0});
    const slice::Walls fast = render::walls_of(picture, *stage.host.mesh, branches);
    const slice::Walls exact = slice::walls_of(picture, lumens);
    REQUIRE(fast.size() == exact.size());
    for (std::size_t row = 3; row + 3 < fast.size(); ++row) {
        REQUIRE(fast[row]);
        REQUIRE(exact[row]);
        CHECK(fast[row]->left == doctest::Approx(exact[row]->left).epsilon(1e-6));
        CHECK(fast[row]->right == doctest::Approx(exact[row]->right).epsilon(1e-6));
    }
}

TEST_CASE("ways follow their branches on an edited tree, and are gone with them") {
    test::CommandStage stage(test::built_tree(
        {{{0, 0, 0}, 2.0}, {{0, 0, 30}, 2.0}, {{10, 0, 60}, 1.0}, {{-10, 0, 60}, 1.0}}, {{0, 1}, {1, 2}, {1, 3}}));
    stage.good("along root..2");
    REQUIRE(stage.document.session().slices.along);
    const glm::dvec3 end = stage.assets.followed.path->samples.back().at;
    stage.good("delete-spur 1");
    if (const auto& along = stage.document.session().slices.along) {
        refresh(stage.assets, stage.document);
        REQUIRE(stage.assets.followed.path);
        CHECK(glm::distance(stage.assets.followed.path->samples.back().at, end) < 1e-9);
        CHECK(along->way.to);
    }
    stage.good("undo");
    refresh(stage.assets, stage.document);
    // Undone edits have other branches.
    CHECK_FALSE(stage.document.session().slices.along);
}
