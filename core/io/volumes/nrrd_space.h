// Which axes of an NRRD file are those of space, and where its voxels lie.
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
    std::size_t layers = 1;        // numbers of each voxel, one after the other in the file
    std::optional<double> unit_mm; // that the file states
    glm::dmat4 to_patient{1.0};    // checked
};

// How a first axis of a file may be taken whose numbers belong to one place.
enum class ListAxis { kRefused, kLayers };

// What is assumed is added to `notes`. Fails on more than one number for each place, naming the axis, except for layers
// along a first axis of the kind "list" where these are allowed.
[[nodiscard]] Result<NrrdSpace> nrrd_space(const HeaderText& header, ListAxis list, std::vector<std::string>& notes);

} // namespace ramus::io
