// Writes label maps: volumes of whole numbers, each the label of a named part, such as a territory of an organ.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::io {

struct LabelMap {
    glm::ivec3 size{0};
    glm::dmat4 to_patient{1.0};                                             // from voxel indices to mm (RAS)
    tree::Claims claims;                                                    // what is not known is not written
    std::vector<volume::LabelName> names;                                   // ascending, all labels but 0
    std::function<void(int k, std::span<std::uint16_t> labels)> fill_slice; // x fastest; all are 0 before
};

// The kinds of files, for help: ".nii.gz, .nii, .seg.nrrd or .nrrd".
[[nodiscard]] std::string label_map_extensions();
// Fails if no format has this extension, or the file cannot be written.
[[nodiscard]] Result<void> check_label_map_output(const std::filesystem::path& target);

// Writes NIfTI, with names and colours in a LabelTable extension, or NRRD, with the fields of 3D Slicer's
// segmentations; voxels are compressed except in .nii. Labels take a byte each, or two if one is above 255. Fails if
// the file cannot be written, if a side has more than 32,767 voxels, and when cancelled (what == "cancelled").
[[nodiscard]] Result<void> write_label_map(const LabelMap& map, const std::filesystem::path& target,
                                           const JobRange& job);

} // namespace ramus::io
