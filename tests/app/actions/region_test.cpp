// The region of a scan: places, range, cuts, its own undo, what slices show of it, and the mask that is written.
#include "app/picture/slices.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

// Two vessels along z with values of about 300 in a scan of about -100; the second begins at x = 25.
struct RegionStage : test::CommandStage {
    RegionStage() : CommandStage(test::built_tree({{{10, 10, 5}, 3.0}, {{10, 10, 45}, 3.0}}, {{0, 1}})) {
        test::NiftiFile scan;
        scan.dim = {3, 40, 20, 25, 1, 1, 1, 1};
        scan.type = static_cast<int>(test::NiftiType::kInt16);
        scan.rows = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0};
        std::vector<std::int16_t> values;
        for (int n = 0; n < 40 * 20 * 25; ++n) {
            const int x = n % 40;
            const int y = n / 40 % 20;
            const bool first = x >= 7 && x <= 13 && y >= 7 && y <= 13;
            const bool second = x >= 25 && x <= 31 && y >= 7 && y <= 13;
            values.push_back(static_cast<std::int16_t>((first || second ? 300 : -100) + n % 3));
        }
        scan.put(values);
        test::write_plain(file, scan.bytes());
        good("scan " + file.string() + " --grey");
    }
    [[nodiscard]] const ScanRegion& region() const { return assets.region; }
    const GrownMask& grown() {
        Job job;
        complete_region(assets, job);
        return assets.region.grown;
    }

    TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "scan.nii";
};
constexpr std::uint64_t kVessel = std::uint64_t{7} * 7 * 25;

} // namespace

TEST_CASE("a region grows from a place by the values that it suggests, and from several places") {
    RegionStage stage;
    CHECK(stage.bad("region-grow more").find("no region") != std::string::npos);
    stage.good("region 10,10,20");
    CHECK(stage.region().now().suggested);
    CHECK(stage.region().now().low <= 300.0);
    CHECK(stage.region().now().high >= 302.0);
    REQUIRE(stage.grown().region);
    CHECK(stage.grown().region->count == kVessel);
    CHECK(stage.grown().region->touches_border);
    stage.good("region-add 28,10,20");
    CHECK(stage.grown().region->count == 2 * kVessel);
    stage.good("region 28,10,20"); // begins anew
    CHECK(stage.grown().region->count == kVessel);
    stage.good("region-range -200,400");
    CHECK(stage.grown().region->count == std::uint64_t{40} * 20 * 25);
    stage.good("region-range auto");
    CHECK(stage.grown().region->count == kVessel);
    stage.good("region-range 310,320");
    CHECK_FALSE(stage.grown().region);
    CHECK_FALSE(stage.grown().trouble.empty());
    CHECK(stage.document.step_count() == 1); // the scan: regions are no steps of the session
}

TEST_CASE("grow less takes back grow more, and keeps the values of the places") {
    RegionStage stage;
    stage.good("region 10,10,20\nregion-range 200,400\nregion-grow more");
    CHECK(stage.region().now().low == doctest::Approx(180.0));
    CHECK(stage.region().now().high == doctest::Approx(420.0));
    stage.good("region-grow less");
    CHECK(stage.region().now().low == doctest::Approx(200.0));
    CHECK(stage.region().now().high == doctest::Approx(400.0));
    for (int n = 0; n < 60; ++n) stage.good("region-grow less");
    const auto scan = stage.assets.scan(stage.marks().scans[0]);
    const double value = volume::value_at(*scan->volume, stage.region().now().seeds[0]);
    CHECK(stage.region().now().low <= value);
    CHECK(stage.region().now().high >= value);
    CHECK(stage.grown().region);
}

TEST_CASE("cuts stop a region, and every step is taken back") {
    RegionStage stage;
    stage.good("region 10,10,10\nregion-cut 10,10,25 0,0,1 8");
    CHECK(stage.grown().region->count == std::uint64_t{7} * 7 * 13); // slices up to 24 mm
    stage.good("region-undo\nregion-cut 10,10,25 30");
    CHECK_FALSE(stage.grown().region); // the ball holds the place
    stage.good("region-undo");
    CHECK(stage.grown().region->count == kVessel);
    stage.good("region-off");
    CHECK_FALSE(stage.region().exists());
    stage.good("region-undo\nregion-undo");
    CHECK_FALSE(stage.region().exists());
    CHECK(stage.bad("region-undo").find("no step") != std::string::npos);
}

TEST_CASE("slices tint the region while its scan is shown") {
    RegionStage stage;
    stage.good("region 10,10,20");
    (void)stage.grown();
    Viewing viewing;
    viewing.size = {80, 40};
    const auto masks = [&] {
        return compose_slice(stage.document.session(), stage.assets, slice::Direction::kAxial, viewing).masks.size();
    };
    CHECK(masks() == 1);
    stage.good("object-hide scan 1");
    CHECK(masks() == 0);
    CHECK(stage.bad("region 10,10,20").find("no scan") != std::string::npos);
    stage.good("object-show scan 1\nregion-off");
    CHECK(masks() == 0);
    stage.good("scan-as 1 labels");
    CHECK(stage.bad("region 10,10,20").find("labels") != std::string::npos);
}

TEST_CASE("the mask that is written has the region's voxels in the place of the scan") {
    RegionStage stage;
    stage.good("region 10,10,20");
    for (const char* name : {"m.nii.gz", "m.nrrd"}) {
        const std::string mask = (stage.folder.path() / name).string();
        CHECK(stage.good("region-save " + mask).find("no segmentation") != std::string::npos);
        Job job;
        const auto read = io::read_volume(mask, {}, job);
        REQUIRE(read);
        CHECK(read->size == glm::ivec3(40, 20, 25));
        std::uint64_t inside = 0;
        for (int k = 0; k < 25; ++k)
            for (int j = 0; j < 20; ++j)
                for (int i = 0; i < 40; ++i) {
                    const bool wanted = i >= 7 && i <= 13 && j >= 7 && j <= 13;
                    CHECK((volume::value_at(*read, {i, j, k}) != 0.0) == wanted);
                    inside += wanted ? 1 : 0;
                }
        CHECK(inside == kVessel);
        CHECK(read->to_patient[2][2] == doctest::Approx(2.0));
    }
    CHECK(stage.bad("region-save " + (stage.folder.path() / "m.stl").string()).find("m.stl") != std::string::npos);
    CHECK(stage.bad("region-save").find("FILE") != std::string::npos);
    CHECK(stage.bad("region-tree x.nii").find("skeletonize") != std::string::npos);
}

TEST_CASE("invalid regions are refused") {
    RegionStage stage;
    stage.good("region 10,10,20");
    for (const char* line : {"region", "region 1,2", "region 500,0,0", "region-add x", "region-range 5",
                             "region-range 5,1", "region-range nan,3", "region-grow most", "region-cut 1,2,3",
                             "region-cut 1,2,3 0", "region-cut 1,2,3 0,0,0 4", "region-radius 3", "region-radius -1"})
        CHECK_FALSE(stage.bad(line).empty());
    CHECK(stage.region().now().cuts.empty());
}
