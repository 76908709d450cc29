// What a mask or a scan holds, for who decides what becomes of it: size, spacing, labels with their volumes, and what
// thresholds make of it.
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
    std::string name; // empty: the file names none
    std::uint64_t voxels = 0;
    double volume_mm3 = 0.0;
};

struct VolumeFacts {
    glm::ivec3 size{0};      // voxels
    glm::dvec3 spacing_mm{}; // units, where nobody has said what they are
    double voxel_mm3 = 0.0;
    tree::Claims claims;
    std::string type, orientation; // as of Volume
    double minimum = 0.0, maximum = 0.0;
    bool mask = false;              // what it is taken for; else a scan, whose values are no labels
    bool all_at_once = false;       // all labels together are what is inside without a word
    std::vector<LabelFacts> labels; // of whole numbers, as many as a mask may have; else empty
    // Of a scan, and of what may be one, so that somebody has to say; null: of others, and where all values are equal.
    std::shared_ptr<const volume::ThresholdCurve> curve;
    std::vector<std::string> suspicions;

    [[nodiscard]] bool may_be_either() const { return curve && !labels.empty(); }
};

// Reads all of the file.
[[nodiscard]] Result<VolumeFacts> read_volume_facts(const std::filesystem::path& path, const io::ReadOptions& options,
                                                    double memory_bytes, Job& job);

// "A mask with 2 labels", "A scan, values from -1024 to 3071".
[[nodiscard]] std::string words_for(const VolumeFacts& facts);

} // namespace ramus::app
