// What a mask or a scan holds, for who decides what becomes of it: size, spacing, labels with their volumes.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/imported_tree.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
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
    tree::Claims claims;
    std::string type, orientation; // as of Volume
    double minimum = 0.0, maximum = 0.0;
    bool mask = false;              // else a scan, whose values are no labels
    std::vector<LabelFacts> labels; // of a mask of whole numbers
    std::vector<std::string> suspicions;
};

// Reads all of the file.
[[nodiscard]] Result<VolumeFacts> read_volume_facts(const std::filesystem::path& path, const io::ReadOptions& options,
                                                    double memory_bytes, Job& job);

// "A mask with 2 labels", "A scan, values from -1024 to 3071".
[[nodiscard]] std::string words_for(const VolumeFacts& facts);

} // namespace ramus::app
