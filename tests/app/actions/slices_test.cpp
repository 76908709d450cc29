// Scans and slices: opening, windows as steps of undo, views that are none, sessions, and what slices show.
#include "app/picture/compose_sheet.h"
#include "app/picture/slices.h"
#include "app/session/session_file.h"
#include "core/slice/sample.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// A vessel along z through the middle of a scan whose values are 10 x - 500.
struct SliceStage : test::CommandStage {
    SliceStage() : CommandStage(test::built_tree({{{20, 15, 5}, 2.0}, {{20, 15, 45}, 2.0}}, {{0, 1}})) {
        test::NiftiFile scan;
        scan.dim = {3, 40, 30, 25, 1, 1, 1, 1};
        scan.type = static_cast<int>(test::NiftiType::kInt16);
        scan.rows = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0};
        std::vector<std::int16_t> values;
        for (int n = 0; n < 40 * 30 * 25; ++n) values.push_back(static_cast<std::int16_t>(10 * (n % 40) - 500));
        scan.put(values);
        test::write_plain(file, scan.bytes());
        test::NiftiFile mask;
        mask.dim = scan.dim;
        mask.rows = scan.rows;
        std::vector<std::uint8_t> labels(std::size_t{40} * 30 * 25);
        for (int n = 0; n < 40 * 30 * 25; ++n)
            labels[static_cast<std::size_t>(n)] = n % 40 < 10 ? 0 : n % 40 < 20 ? 1 : 3;
        mask.put(labels);
        test::write_plain(labels_file, mask.bytes());
    }
    [[nodiscard]] const SliceViews& views() const { return document.session().slices; }

    TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "scan.nii";
    std::filesystem::path labels_file = folder.path() / "labels.nii";
};

} // namespace

TEST_CASE("scans are opened in grey or as labels, each as a step of undo") {
    SliceStage stage;
    CHECK(stage.good("scan " + stage.file.string()).find("40 x 30 x 25 voxels") != std::string::npos);
    REQUIRE(stage.marks().scans.size() == 1);
    CHECK_FALSE(stage.marks().scans[0].labels);
    CHECK_FALSE(stage.marks().scans[0].checksum.empty());
    CHECK(stage.views().layout == SliceLayout::kPicture); // without a window
    stage.good("scan " + stage.labels_file.string());
    CHECK(stage.marks().scans[1].labels);
    CHECK(stage.views().layout == SliceLayout::kPicture);
    CHECK(stage.bad("scan " + stage.file.string()).find("shown already") != std::string::npos);
    stage.good("object-remove scan 1\nundo\nundo\nundo");
    CHECK(stage.marks().scans.empty());
}

TEST_CASE("windows are steps of undo; layout, crosshair and planes are not") {
    SliceStage stage;
    stage.good("scan " + stage.file.string());
    const std::size_t steps = stage.document.step_count();
    stage.good("crosshair 10,11,12.5\nlayout large\nslice axial 20\nslab 6 mean\ncut-away coronal --behind");
    CHECK(stage.document.step_count() == steps);
    CHECK(stage.views().crosshair == glm::dvec3(10, 11, 20));
    CHECK(stage.views().in_picture[slice_index(slice::Direction::kCoronal)]);
    stage.good("window 400,40");
    CHECK(stage.marks().scans[0].window == slice::Window{40.0, 400.0});
    stage.good("window liver 1\nwindow auto");
    CHECK_FALSE(stage.marks().scans[0].window);
    stage.good("undo");
    CHECK(stage.marks().scans[0].window == slice::window_named("liver"));
    CHECK(stage.document.step_count() == steps + 3);
}

TEST_CASE("slices go to places of vessels, and step by voxels towards superior, anterior and right") {
    SliceStage stage;
    stage.good("scan " + stage.file.string() + "\ncrosshair 0@0.25");
    CHECK(glm::distance(*stage.views().crosshair, glm::dvec3(20, 15, 15)) < 1e-9);
    stage.good("slice-step axial 2\nslice-step coronal -3\nslice-step sagittal 1");
    CHECK(glm::distance(*stage.views().crosshair, glm::dvec3(21, 12, 19)) < 1e-9);
    stage.good("slice-across 0@0.5");
    CHECK(glm::distance(stage.views().oblique_normal, glm::dvec3(0, 0, 1)) < 1e-9);
    stage.good("slice-through 0,0,0 10,0,0 0,10,10");
    CHECK(std::abs(glm::dot(stage.views().oblique_normal, glm::normalize(glm::dvec3(0, -1, 1)))) ==
          doctest::Approx(1.0));
}

TEST_CASE("invalid scans and slices are refused") {
    SliceStage stage;
    CHECK(stage.bad("scan " + (stage.folder.path() / "none.nii").string()).find("none.nii") != std::string::npos);
    CHECK(stage.bad("window 400,40").find("scan") != std::string::npos);
    stage.good("scan " + stage.file.string());
    for (const char* line :
         {"layout both", "crosshair 1,2", "crosshair 7@0.5", "crosshair 0@2", "slice axial", "slice oblique 3",
          "slice-step axial x", "slice-through 0,0,0 1,1,1 2,2,2", "cut-away front", "slab thick", "slice-zoom axial 0",
          "slice-show colours", "window 0,40", "window 400,nan", "window skin", "slice-across 5", "scan-as 1 tree"})
        CHECK_FALSE(stage.bad(line).empty());
}

TEST_CASE("a session keeps its slices, and refuses a scan that was changed") {
    SliceStage stage;
    stage.good("scan " + stage.file.string() + "\nscan " + stage.labels_file.string() +
               "\nwindow 300,100\ncrosshair 1,2,3\nslice-zoom axial 2.5 3,-4\nslab 5 minimum\ncut-away sagittal\n"
               "slice-show axes off\nslice-across 0@0.5\nlayout coronal");
    const Session& session = stage.document.session();
    const auto read = session_from_json(to_json(session, "/data"), "/data", "s.json");
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message()));
    CHECK(read->session.slices == session.slices);
    CHECK(read->session.marks.scans.size() == 2);
    CHECK(read->session.marks.scans[0].window == session.marks.scans[0].window);
    CHECK(read->session.marks.scans[0].checksum == session.marks.scans[0].checksum);

    Assets assets;
    Job job;
    REQUIRE(load_scans(assets, session.marks, job));
    test::NiftiFile other;
    other.dim = {3, 2, 2, 2, 1, 1, 1, 1};
    other.put(std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7});
    test::write_plain(stage.file, other.bytes());
    Assets fresh;
    const auto changed = load_scans(fresh, session.marks, job);
    REQUIRE_FALSE(changed);
    CHECK(changed.error().what.find("changed") != std::string::npos);
}

TEST_CASE("the parts of a layout fill the picture, and a slice shows all of its scan") {
    SliceStage stage;
    stage.good("scan " + stage.file.string());
    Session session = stage.document.session();
    for (const auto& [layout, known] : kSliceLayouts)
        for (const glm::ivec2 size : {glm::ivec2(801, 600), glm::ivec2(500, 900), glm::ivec2(3, 3)}) {
            const std::string_view name = known;
            CAPTURE(name);
            session.slices.layout = layout;
            const std::vector<Viewport> parts = viewports_of(session, size, 1.0F);
            CHECK(std::ranges::count_if(parts, [](const Viewport& part) { return !part.slice; }) ==
                  (has_tree(layout) ? 1 : 0));
            for (std::size_t a = 0; a < parts.size(); ++a) {
                CHECK(glm::all(glm::greaterThanEqual(parts[a].at, glm::ivec2(0))));
                CHECK(glm::all(glm::lessThanEqual(parts[a].at + parts[a].size, glm::max(size, parts[a].at + 1))));
                for (std::size_t b = 0; b < a && size.x > 3; ++b) // they do not overlap
                    CHECK_FALSE((parts[a].at.x < parts[b].at.x + parts[b].size.x &&
                                 parts[b].at.x < parts[a].at.x + parts[a].size.x &&
                                 parts[a].at.y < parts[b].at.y + parts[b].size.y &&
                                 parts[b].at.y < parts[a].at.y + parts[a].size.y));
            }
        }
    for (const slice::Direction direction :
         {slice::Direction::kAxial, slice::Direction::kCoronal, slice::Direction::kSagittal}) {
        const slice::PixelGrid grid = grid_of(session, stage.assets, direction, {400, 300});
        const auto bounds = slice::bounds_of(*stage.assets.scan(session.marks.scans[0])->volume);
        CHECK(std::abs(grid.plane().height(crosshair_of(session, stage.assets))) < 1e-9);
        for (const glm::dvec3& corner : {bounds.least, bounds.most}) {
            const glm::dvec2 pixel = grid.pixel(corner);
            CHECK(glm::all(glm::greaterThan(pixel, glm::dvec2(-0.51))));
            CHECK(glm::all(glm::lessThan(pixel, glm::dvec2(grid.size) - 0.49)));
        }
    }
}

TEST_CASE("words of slices claim what the files claim") {
    const slice::Plane plane{{-12.34, 5.0, 100.06}, {0, 0, 1}};
    CHECK(caption_of(slice::Direction::kAxial, plane, {}, {}) == "Axial, S 100.1 mm");
    CHECK(caption_of(slice::Direction::kSagittal, plane, {.slab = slice::Slab::kMean, .slab_mm = 5.0}, {}) ==
          "Sagittal, L 12.3 mm, mean of 5.00 mm");
    const tree::Claims none{tree::SaidBy::kNobody, tree::SaidBy::kNobody};
    CHECK(caption_of(slice::Direction::kSagittal, plane, {}, none) == "Sagittal, x -12.3 units");
    CHECK(place_words(plane.point, {}) == "L 12.3, A 5.0, S 100.1 mm");
    SliceStage stage;
    stage.good("scan " + stage.file.string() + "\nscan " + stage.labels_file.string());
    CHECK(value_words({12.2, 5.0, 4.0}, stage.document.session(), stage.assets) == "-380   label 1");
    CHECK(value_words({5.0, 5.0, 4.0}, stage.document.session(), stage.assets) == "-450");
    CHECK(value_words({-50.0, 5.0, 4.0}, stage.document.session(), stage.assets).empty());
}

TEST_CASE("the slice that fills the picture is stepped by its name, or the axial one") {
    SliceStage stage;
    stage.good("scan " + stage.file.string() + "\ncrosshair 10,11,20\nslice-step shown 1");
    CHECK(stage.views().crosshair == glm::dvec3(10, 11, 22));
    stage.good("layout coronal\nslice-step shown -2");
    CHECK(stage.views().crosshair == glm::dvec3(10, 9, 22));
    stage.bad("slice-step shown");
    CHECK(stage.bad("copy-place").find("clipboard") != std::string::npos);
    stage.bad("copy-place 1,2");
}
