#include "app/assets/region.h"

#include "app/session/numbers.h"
#include "core/io/volumes/label_map_file.h"
#include "core/volume/mask_volume.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <span>
#include <utility>

namespace ramus::app {

namespace {

constexpr double kWiden = 0.1;                            // of the range, on either side
constexpr double kNarrow = kWiden / (1.0 + 2.0 * kWiden); // takes kWiden back
constexpr std::size_t kMostSteps = 1000;                  // of undo
constexpr double kLeastShare = 0.005;                     // of the values of the scan, for ranges without width

double least_step(const volume::Volume& scan) {
    return volume::holds_whole_numbers(scan) ? 1.0 : kLeastShare * (scan.maximum - scan.minimum);
}

} // namespace

void ScanRegion::change(RegionOf next) {
    if (next == now()) return;
    if (steps_.size() == kMostSteps) steps_.erase(steps_.begin());
    steps_.push_back(std::move(next));
}

Result<Scan> scan_to_grow_in(const SceneObjects& objects) {
    if (const Scan* scan = objects.grey_scan()) return *scan;
    if (std::ranges::any_of(objects.scans, [](const Scan& one) { return one.visible; }))
        return fail("only labels are shown, and a region grows by the values of a scan", {},
                    "open a scan, or show this one in grey: `scan-as 1 grey`");
    return fail("there is no scan to grow a region in", {}, "open one with `scan FILE`");
}

Result<glm::ivec3> voxel_at(const volume::Volume& scan, const glm::dvec3& place_mm) {
    const glm::dvec3 at(glm::round(glm::dvec3(glm::inverse(scan.to_patient) * glm::dvec4(place_mm, 1.0))));
    if (glm::all(glm::greaterThanEqual(at, glm::dvec3(0.0))) && glm::all(glm::lessThan(at, glm::dvec3(scan.size))))
        return glm::ivec3(at);
    return fail("the place " + rounded(place_mm.x) + ", " + rounded(place_mm.y) + ", " + rounded(place_mm.z) +
                    " is outside of the scan",
                {}, "choose one inside");
}

glm::dvec3 place_of(const volume::Volume& scan, const glm::ivec3& voxel) {
    return glm::dvec3(scan.to_patient * glm::dvec4(glm::dvec3(voxel), 1.0));
}

Result<RegionOf> with_seed(RegionOf region, const volume::Volume& scan, const glm::ivec3& seed) {
    if (region.suggested) {
        RAMUS_TRY(range, volume::suggested_range(scan, seed));
        region.low = region.seeds.empty() ? range.low : std::min(region.low, range.low);
        region.high = region.seeds.empty() ? range.high : std::max(region.high, range.high);
    }
    region.seeds.push_back(seed);
    return region;
}

RegionOf widened(RegionOf region, const volume::Volume& scan) {
    const double step = std::max(kWiden * (region.high - region.low), least_step(scan));
    region.low -= step;
    region.high += step;
    region.suggested = false;
    return region;
}

RegionOf narrowed(RegionOf region, const volume::Volume& scan) {
    const double step = std::max(kNarrow * (region.high - region.low), least_step(scan));
    double low = region.low + step;
    double high = region.high - step;
    for (const glm::ivec3& seed : region.seeds) {
        const double value = volume::value_at(scan, seed);
        if (value < region.low || value > region.high) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) low = high = 0.5 * (low + high);
    region.low = low;
    region.high = high;
    region.suggested = false;
    return region;
}

Result<volume::GrownRegion> grown_region(const RegionOf& region, const volume::Volume& scan, std::uint64_t most_voxels,
                                         const JobRange& job) {
    volume::RegionGrowing growing{.seeds = region.seeds, .low = region.low, .high = region.high};
    growing.most_voxels = most_voxels;
    for (const RegionCut& cut : region.cuts) {
        if (cut.normal)
            growing.discs.push_back({cut.centre_mm, *cut.normal, cut.radius_mm});
        else
            growing.balls.push_back({cut.centre_mm, cut.radius_mm});
    }
    return volume::grow_region(scan, growing, job);
}

Result<GrownMask> grown_mask(const RegionOf& region, const volume::Volume& scan, const JobRange& job) {
    GrownMask made{region};
    auto grown = grown_region(region, scan, kMostRegionVoxels, job);
    if (!grown && job.cancelled()) return tl::unexpected(grown.error());
    if (!grown) {
        made.trouble = grown.error().message();
        return made;
    }
    made.shown = std::make_shared<const volume::Volume>(volume::mask_volume(grown->mask, scan));
    made.region = std::make_shared<const volume::GrownRegion>(std::move(*grown));
    return made;
}

Result<void> write_region(const volume::GrownRegion& region, const volume::Volume& scan, const tree::Claims& claims,
                          const std::filesystem::path& file, const JobRange& job) {
    io::LabelMap map{scan.size, scan.to_patient, claims, {{1, "grown region", kRegionColour}}, {}};
    const auto across = static_cast<std::size_t>(scan.size.x);
    map.fill_slice = [&](int k, std::span<std::uint16_t> labels) {
        for (int j = 0; j < scan.size.y; ++j)
            volume::for_row_runs(region.mask, j, k, [&](int first, int end) {
                const std::size_t row = across * static_cast<std::size_t>(j);
                std::ranges::fill(
                    labels.subspan(row + static_cast<std::size_t>(first), static_cast<std::size_t>(end - first)),
                    std::uint16_t{1});
            });
    };
    return io::write_label_map(map, file, job);
}

std::string words_of_region(const volume::GrownRegion& region, const ScanFile& scan) {
    const double mm3 = static_cast<double>(region.count) * volume::voxel_volume_mm3(scan.volume->to_patient);
    return counted(region.count, "voxel", "voxels") + ", " + Lengths(scan.claims).volume(mm3);
}

std::vector<std::string> remarks_on(const volume::GrownRegion& region) {
    std::vector<std::string> remarks;
    if (region.stopped_at_limit)
        remarks.push_back("It was stopped at " + counted(region.count, "voxel", "voxels") +
                          ": it probably leaks. Narrow the range, or cut where it leaves the vessel.");
    if (region.touches_border) remarks.emplace_back("It touches the border of the scan.");
    if (!region.unused.empty())
        remarks.push_back(counted(region.unused.size(), "seed is", "seeds are") +
                          " not used: out of the range, or in a cut.");
    return remarks;
}

} // namespace ramus::app
