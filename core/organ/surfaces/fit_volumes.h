// Moves the vertices of label surfaces until each label has its volume. All positions are in voxels.
//
// Each label gets a pressure, and each vertex moves by the sum of the pressures times the gradients of the volumes,
// divided by the area around it. The pressures that give the volumes to first order are those of the least move. Labels
// that are still off (small ones, whose vertices are at the ends of their ways) go back toward the corners of voxels,
// where volumes are exact.
#pragma once

#include "core/base/large_array.h"
#include "core/organ/surfaces/label_net.h"

namespace ramus::organ::surfaces {

// Largest error of a label's volume, as a fraction of it.
inline constexpr double kMostVolumeError = 0.009;

// What bounds volumes: triangles with the labels on their two sides, numbered from 0 (the outside of the organ).
struct Bounded {
    std::span<const glm::uvec3> triangles;
    std::span<const std::array<std::uint32_t, 2>> labels; // by triangle: inside, outside
    std::span<const double> volumes;                      // by label, in voxels; not of label 0
    double orientation = 1.0;                             // -1: triangles are clockwise in voxels
};

void fit_volumes(const Bounded& surfaces, std::span<const glm::vec3> corners, LargeArray<glm::vec3>& places,
                 const JobRange& job);

} // namespace ramus::organ::surfaces
