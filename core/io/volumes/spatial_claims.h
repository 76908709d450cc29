// SpatialClaims: what a file of a microscope states about space: distances of voxels and an origin, along axes of its
// own. Such files know no patient, so the sides are always assumed, and said to be.
#pragma once

#include "core/base/error.h"
#include "core/volume/volume.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct SpatialClaims {
    // Along x, y and z, in mm where the unit is stated, else in units. None: not stated.
    std::array<std::optional<double>, 3> spacing;
    glm::dvec3 origin{0.0};        // of voxel (0, 0, 0), in the same unit
    std::optional<double> unit_mm; // none: not stated
    std::vector<std::string> notes, suspicions;
};

// Whether a number can be the distance of voxels: positive and finite.
[[nodiscard]] bool can_be_spacing(double value);

// The length of a unit in mm, also in ImageJ's spellings of the micrometre. None: no unit of length ("pixel").
[[nodiscard]] std::optional<double> microscopy_unit_mm(std::string_view unit);

// Places the volume, whose size is set: sets to_patient, unit_mm, notes and suspicions. Distances that are not stated
// are assumed, with a note: pixels are square, and slices as far apart as pixels. Fails if voxels would be where no
// patient can be.
[[nodiscard]] Result<void> place_by(const SpatialClaims& claims, volume::Volume& volume, const std::string& name);

} // namespace ramus::io
