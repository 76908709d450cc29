// Surfaces to compare with that cannot be made: what is told, and that the work ends.
#include "app/workspace/workspace.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

TEST_CASE("if several surfaces for a comparison fail, each is tried only once") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("fork.swc", "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n"));
    REQUIRE(test::settle(workspace, [&] { return workspace.surface_ready(); }));
    Marks marks = workspace.document().marks();
    const auto compare = [&](std::vector<Compared> surfaces, const std::string& mask) {
        marks.comparison.surfaces = std::move(surfaces);
        marks.comparison.mask = mask;
        workspace.document().change(marks);
        CHECK(workspace.awaited(WorkKind::kComparison));
        REQUIRE(
            test::settle(workspace, [&] { return !workspace.busy() && !workspace.awaited(WorkKind::kComparison); }));
    };
    marks.options.method = mesh::Method::kTruncatedCones;
    marks.options.cell_mm = 1e-9; // finer than numbers are
    marks.comparison.mode = Comparison::Mode::kSideBySide;
    const std::string missing = (folder.path() / "missing.nii").string();
    compare({Compared::kMerged, Compared::kTruncatedCones, Compared::kIsosurface}, missing);
    CHECK_FALSE(workspace.problem(WorkKind::kComparison).empty());
    CHECK_FALSE(workspace.surfaces().of(Compared::kMerged));
    CHECK_FALSE(workspace.surfaces().of(Compared::kIsosurface));
    // What is told is of what is compared with now.
    compare({Compared::kTruncatedCones, Compared::kIsosurface}, (folder.path() / "other.nii").string());
    CHECK(workspace.problem(WorkKind::kComparison).find("other.nii") != std::string::npos);
    compare({Compared::kTruncatedCones, Compared::kIsosurface}, {});
    CHECK(workspace.problem(WorkKind::kComparison).empty());
    CHECK(workspace.surfaces().of(Compared::kIsosurface));
    compare({Compared::kTruncatedCones, Compared::kIsosurface}, missing); // tried again
    CHECK(workspace.problem(WorkKind::kComparison).find("missing.nii") != std::string::npos);
}
