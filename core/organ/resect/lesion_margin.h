// Margins: how far each lesion is from the surface of the resections, within the organ.
//
// The distance is the least one between the surface of the lesion's voxel boxes and the exact surface of the resections
// within the organ's voxel boxes, mm. Method: the nearest triangles of the surface, whose voxels are then halved until
// the triangles are within 1e-5 mm of the exact surface, the most promising first.
//
// Guaranteed: the error is below 1e-4 mm for half spaces, sheets and meshes. Not guaranteed: the same for a margin
// around voxels whose surface has creases; there the error is below 0.01 of a voxel.
#pragma once

#include "core/base/job.h"
#include "core/organ/organ.h"
#include "core/organ/resect/resection.h"
#include "core/organ/resect/resection_surface.h"
#include "core/organ/resect/voxel_solid.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ramus::organ {

// How much of a lesion is removed, by the centres of its voxels.
enum class Removed : std::uint8_t { kNone, kPart, kWhole };
[[nodiscard]] std::string_view name_of(Removed removed); // "none", "part", "whole"

struct Margin {
    Removed removed = Removed::kNone;
    // None: no surface lies within the organ. 0: the surface passes through the lesion.
    std::optional<double> distance_mm;
    glm::dvec3 on_lesion{0.0}, on_surface{0.0}; // the nearest places
};

// One for each lesion. `surface`: of these resections of the organ.
[[nodiscard]] std::vector<Margin> margins_of(const Organ& organ, std::span<const Resection> resections,
                                             const ResectionSurface& surface, std::span<const VoxelLesion> lesions);

// By vertex of the surface: the distance (mm) from the nearest lesion, 0 inside of it; for bands of colour. Infinite
// without lesions.
[[nodiscard]] std::vector<float> lesion_distances(const ResectionSurface& surface,
                                                  std::span<const VoxelLesion> lesions);

} // namespace ramus::organ
