// Summary of a mask or a scan, for choosing how to open it: size, spacing, labels with volumes, and the effect of
// thresholds.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/imported_tree.h"
#include "core/volume/threshold.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct LabelFacts {
    std::int32_t label = 0;
    std::string name; // empty: no name in the file
    std::uint64_t voxels = 0;
    double volume_mm3 = 0.0;
};

struct VolumeFacts {
    glm::ivec3 size{0};      // voxels
    glm::dvec3 spacing_mm{}; // units if the unit is unknown
    double voxel_mm3 = 0.0;
    tree::Claims claims;
    std::string type, orientation; // see Volume
    double minimum = 0.0, maximum = 0.0;
    bool mask = false;              // assumed to be a mask; false: a scan
    bool all_at_once = false;       // all labels together are inside by default
    std::vector<LabelFacts> labels; // if values are integers, and few enough for a mask
    // For scans and for files that may be scans, which the user must decide; null for others, and if all values are
    // equal.
    std::shared_ptr<const volume::ThresholdCurve> curve;
    std::vector<std::string> suspicions;

    [[nodiscard]] bool may_be_either() const { return curve && !labels.empty(); }
};

// Reads the whole file.
[[nodiscard]] Result<VolumeFacts> read_volume_facts(const std::filesystem::path& path, const io::ReadOptions& options,
                                                    double memory_bytes, Job& job);

// "A mask with 2 labels", "A scan, values from -1024 to 3071".
[[nodiscard]] std::string words_for(const VolumeFacts& facts);

} // namespace ramus::app
