// The region of a scan that a person grows from a click in a vessel: seeds, a range of values, and cuts where the
// region must stop (core/volume/grow_region.h). A help to get a mask, not a segmentation: it leaks wherever
// neighbouring tissue has similar values. It belongs neither to the session nor to its undo; its own steps are kept
// here.
#pragma once

#include "app/assets/scans.h"
#include "app/session/objects.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/grow_region.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

inline constexpr const char* kRegionIsNoSegmentation =
    "a region of values is no segmentation: compare it with the scan on every slice";
// Where the preview of a region stops: more than all vessels of a body have, and a second of work.
inline constexpr std::uint64_t kMostRegionVoxels = 30'000'000;
inline constexpr Rgb kRegionColour{64, 214, 224};

// A place where growing stops: a disc across a vessel, or a ball.
struct RegionCut {
    glm::dvec3 centre_mm{0.0};          // RAS
    std::optional<glm::dvec3> normal{}; // of a disc; none: a ball
    double radius_mm = 0.0;
    bool operator==(const RegionCut&) const = default;
};

// What a region is grown from.
struct RegionOf {
    ScanSource scan;
    std::vector<glm::ivec3> seeds; // voxels; empty: there is no region
    double low = 0.0, high = 0.0;  // of values; both belong to the range
    bool suggested = true;         // the range comes from the seeds
    std::vector<RegionCut> cuts{};
    bool operator==(const RegionOf&) const = default;
};

// A region that was grown, or why not.
struct GrownMask {
    RegionOf of;
    std::shared_ptr<const volume::GrownRegion> region{}; // null: nothing was grown
    std::shared_ptr<const volume::Volume> shown{};       // 1 inside, 0 outside
    std::string trouble{};
};

// The region as it is wanted, as it was grown last, and its earlier steps.
class ScanRegion {
public:
    [[nodiscard]] const RegionOf& now() const { return steps_.empty() ? none_ : steps_.back(); }
    [[nodiscard]] bool exists() const { return !now().seeds.empty(); }
    [[nodiscard]] bool can_undo() const { return !steps_.empty(); }
    void change(RegionOf next);
    void undo() {
        if (can_undo()) steps_.pop_back();
    }
    void forget() { *this = {}; } // with its steps
    GrownMask grown;              // may be of an earlier step
    [[nodiscard]] bool is_current() const { return grown.of == now(); }

private:
    std::vector<RegionOf> steps_;
    RegionOf none_;
};

// The scan that regions grow in: the first visible scan in grey. Fails if there is none.
[[nodiscard]] Result<Scan> scan_to_grow_in(const SceneObjects& objects);

// The voxel at a place in mm (RAS). Fails if the place is outside of the scan.
[[nodiscard]] Result<glm::ivec3> voxel_at(const volume::Volume& scan, const glm::dvec3& place_mm);
[[nodiscard]] glm::dvec3 place_of(const volume::Volume& scan, const glm::ivec3& voxel); // mm, RAS

// Adds a seed. A suggested range grows to include what the seed suggests. Fails if the seed is not in the scan.
[[nodiscard]] Result<RegionOf> with_seed(RegionOf region, const volume::Volume& scan, const glm::ivec3& seed);
// Widens the range by a tenth of its width on either side, or narrows it by the same. A narrower range keeps the values
// of all seeds that it had.
[[nodiscard]] RegionOf widened(RegionOf region, const volume::Volume& scan);
[[nodiscard]] RegionOf narrowed(RegionOf region, const volume::Volume& scan);

// Fails as volume::grow_region(). `most_voxels`: where growing stops.
[[nodiscard]] Result<volume::GrownRegion> grown_region(const RegionOf& region, const volume::Volume& scan,
                                                       std::uint64_t most_voxels, const JobRange& job);
// With `shown`; an error becomes `trouble`. Fails only if cancelled.
[[nodiscard]] Result<GrownMask> grown_mask(const RegionOf& region, const volume::Volume& scan, const JobRange& job);

// Writes the region as a label map on the grid of the scan: 1 inside, 0 outside. Fails as io::write_label_map().
[[nodiscard]] Result<void> write_region(const volume::GrownRegion& region, const volume::Volume& scan,
                                        const tree::Claims& claims, const std::filesystem::path& file,
                                        const JobRange& job);

// "1,234 voxels, 1.42 ml"
[[nodiscard]] std::string words_of_region(const volume::GrownRegion& region, const ScanFile& scan);
// What a person must know of a region: that it was stopped, that it touches the border of the scan, that seeds have no
// value in the range; one sentence each.
[[nodiscard]] std::vector<std::string> remarks_on(const volume::GrownRegion& region);

} // namespace ramus::app
