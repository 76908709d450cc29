// Determines the spatial axes of an NRRD file and the position of its voxels.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/header_text.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct NrrdSpace {
    glm::ivec3 size{1};
    std::size_t layers = 1;        // numbers for each voxel, adjacent in the file
    std::optional<double> unit_mm; // stated by the file
    glm::dmat4 to_patient{1.0};    // voxel indices to mm, RAS; accepted by check_affine()
};

// Whether a first axis of the kind "list" is refused, or accepted as the layers of a segmentation.
enum class ListAxis { kRefused, kLayers };

// Adds assumptions to `notes`. Fails, naming the axis, on more than one number for each voxel, except for layers if
// `list` accepts them.
[[nodiscard]] Result<NrrdSpace> nrrd_space(const HeaderText& header, ListAxis list, std::vector<std::string>& notes);

} // namespace ramus::io
