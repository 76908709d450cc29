// Validation: what is found is listed, gone to and reported, and behind the window it follows the surface's options.
// Witness: tubes that touch, which the plain sum merges and the other blend keeps apart.
#include "app/reports/report_tables.h"
#include "app/workspace/validation_maker.h"
#include "app/workspace/workspace.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// Two tubes of radius 1 that cross 1.8 mm apart: they overlap by 0.2.
constexpr const char* kCrossing = "1 2 0 -10 0 1 -1\n2 2 0 10 0 1 1\n3 2 -10 0 1.8 1 -1\n4 2 10 0 1.8 1 3\n";

// Along z, from -17 to 17; voxels of 0.5 mm, as NRRD.
std::string mask_of_tube(double radius) {
    constexpr int kAcross = 10, kAlong = 19; // mm on either side
    std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nspace: right-anterior-superior\nsizes: 41 41 77\n"
                       "space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (-10,-10,-19)\n"
                       "encoding: raw\n\n";
    for (int z = -2 * kAlong; z <= 2 * kAlong; ++z)
        for (int y = -2 * kAcross; y <= 2 * kAcross; ++y)
            for (int x = -2 * kAcross; x <= 2 * kAcross; ++x)
                text.push_back(x * x + y * y <= 4.0 * radius * radius && std::abs(z) <= 34 ? 1 : 0);
    return text;
}

std::ptrdiff_t count_of(const TreeValidation& validation, Finding::Kind kind) {
    return std::ranges::count(*validation.findings, kind, &Finding::kind);
}

} // namespace

TEST_CASE("vessels that the surface merges are found, gone to and reported") {
    const TemporaryFolder folder;
    test::CommandStage stage(*io::parse_tree(kCrossing, "crossing.swc"));
    stage.good("surface blend paper\nfinding 1");
    const Finding first = stage.assets.validation.findings->front();
    CHECK(first.kind == Finding::Kind::kMerged);
    CHECK(first.branches == test::Ids{0, 1});
    REQUIRE(stage.assets.validation.found->shape); // two tubes that are one piece
    CHECK(stage.assets.validation.found->shape->surface == mesh::Connectivity{1, 0});
    CHECK(stage.assets.validation.found->shape->tree == mesh::Connectivity{2, 0});
    CHECK(first.value_mm == doctest::Approx(-0.2).epsilon(0.1)); // mm between the walls
    CHECK(glm::distance(first.at, glm::dvec3(0.0, 0.0, 0.9)) < 0.3);
    CHECK(text_of(first, Lengths()).starts_with("overlap 0.2"));
    CHECK(stage.selection() == test::Ids{0, 1});
    CHECK(glm::distance(stage.document.session().camera.focal_point, first.at) < 1e-9);
    const Table table = validation_table(stage.document, stage.assets);
    REQUIRE(table.rows.size() == stage.assets.validation.findings->size());
    CHECK(table.rows[0][1].text == "merged");
    CHECK(csv_of(table).starts_with("finding,kind,branch,other_branch,value,expected,text,x,y,z,unit\r\n"));
    stage.good("report " + (folder.path() / "v.csv").string() + " validation");
    for (const char* wrong : {"finding", "finding 0", "finding 99", "finding x", "finding 1 2"})
        CHECK(stage.bad(wrong).find("which finding?") != std::string::npos);
    // Other options: it is of another surface.
    stage.good("surface blend tree");
    CHECK_FALSE(stage.assets.validation.fits(validation_of(stage.document.tree(), stage.marks())));
    CHECK(validation_table(stage.document, stage.assets).rows.empty());
}

TEST_CASE("the window validates in the background on request, and again when options of the surface change") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("crossing.swc", kCrossing));
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK_FALSE(workspace.awaited(WorkKind::kValidation));
    CHECK(workspace.assets().validation.found == nullptr);
    workspace.want_validation(true);
    CHECK(workspace.awaited(WorkKind::kValidation));
    const auto there = [&] {
        return !workspace.awaited(WorkKind::kValidation) &&
               workspace.assets().validation.fits(
                   validation_of(workspace.document().tree(), workspace.document().marks()));
    };
    REQUIRE(test::settle(workspace, there));
    CHECK(count_of(workspace.assets().validation, Finding::Kind::kMerged) == 0);
    CHECK(workspace.assets().validation.found->radius_error.places > 0);
    Marks next = workspace.document().marks();
    next.options.blend = mesh::Blend::kPaper;
    workspace.document().change(next);
    CHECK(workspace.awaited(WorkKind::kValidation));
    REQUIRE(test::settle(workspace, there));
    CHECK(count_of(workspace.assets().validation, Finding::Kind::kMerged) == 1);
    // Cancelled, it is not tried again by itself; what was found before stays, as of what it was found of.
    next.options.blend = mesh::Blend::kTree;
    workspace.document().change(next);
    workspace.update();
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready(); }));
    const auto cancel = [&] {
        workspace.want_validation(false);
        workspace.update();
        workspace.want_validation(true);
        workspace.update(); // the work begins, and nothing of it is taken over before the next update
        workspace.cancel_work();
        workspace.update();
    };
    if (!workspace.awaited(WorkKind::kValidation))
        workspace.assets().validation.of.tree.reset(); // it was quicker than this test
    cancel();
    CHECK_FALSE(workspace.awaited(WorkKind::kValidation));
    CHECK(workspace.problem(WorkKind::kValidation) == "cancelled");
    CHECK(workspace.assets().validation.found != nullptr);
    CHECK_FALSE(
        workspace.assets().validation.fits(validation_of(workspace.document().tree(), workspace.document().marks())));
    workspace.retry(WorkKind::kValidation);
    CHECK(workspace.awaited(WorkKind::kValidation));
    REQUIRE(test::settle(workspace, there));
    workspace.want_validation(false);
    REQUIRE(workspace.document().undo());
    workspace.update();
    CHECK_FALSE(workspace.awaited(WorkKind::kValidation));
}

TEST_CASE("the radii of cones and of a mask are shown next to those of the surface") {
    const TemporaryFolder folder;
    // A tube of radius 3 along z, and a mask of one of radius 4 in its place.
    const auto tube =
        std::make_shared<const tree::VesselTree>(*io::parse_tree("1 2 0 0 -15 3 -1\n2 2 0 0 15 3 1\n", "tube.swc"));
    Job job;
    ValidationOf of{tube, {}, folder.write("wide.nrrd", mask_of_tube(4.0)).string(), {}, {}};
    const auto made = make_validation(of, job);
    REQUIRE(made);
    CHECK(job.progress() == doctest::Approx(1.0)); // of all its surfaces together
    CHECK(made->fits(of));
    const std::vector<validate::RadiusPlace>& places = made->found->radii;
    REQUIRE(made->cones_mm.size() == places.size());
    REQUIRE(made->mask_mm.size() == places.size());
    const std::size_t middle = places.size() / 2;
    REQUIRE(places[middle].alone);
    CHECK(places[middle].surface_mm == doctest::Approx(3.0).epsilon(0.01));
    CHECK(made->cones_mm[middle] == doctest::Approx(3.0).epsilon(0.02)); // of flat sides
    CHECK(made->mask_mm[middle] == doctest::Approx(4.0).epsilon(0.05));
    // A mask that cannot be read takes nothing else along.
    of.mask = (folder.path() / "missing.nii").string();
    const auto without = make_validation(of, job);
    REQUIRE(without);
    CHECK(without->mask_mm.empty());
    CHECK(without->mask_trouble.find("missing.nii") != std::string::npos);
    CHECK(without->cones_mm.size() == places.size());
}
