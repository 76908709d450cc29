// Bounds of the field over the eight children of a cube, and which segments matter to each: what decides where the
// surface can be. Vectorised over the children, so that short lists of segments fill the lanes.
#pragma once

#include "core/field/convolution_field.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

// What culling reads of a segment, in single precision relative to one origin, side by side in memory.
struct CullingSegment {
    float ax, ay, az, ux, uy, uz;
    float length, radius, slope;
};

struct CullingSegments {
    glm::dvec3 origin{0.0};
    std::vector<CullingSegment> segments;
    explicit CullingSegments(const ConvolutionField& field);
};

// The children of a cube, numbered by the bits of their places: 1 = upper x, 2 = upper y, 4 = upper z.
inline constexpr int kChildren = 8;
struct ChildCentres {
    alignas(32) std::array<float, kChildren> x, y, z;
    ChildCentres(glm::vec3 middle, float child_side) {
        for (std::size_t c = 0; c < kChildren; ++c) {
            x[c] = middle.x + ((c & 1) != 0 ? 0.5F : -0.5F) * child_side;
            y[c] = middle.y + ((c & 2) != 0 ? 0.5F : -0.5F) * child_side;
            z[c] = middle.z + ((c & 4) != 0 ? 0.5F : -0.5F) * child_side;
        }
    }
};

struct ChildBounds {
    alignas(32) std::array<float, kChildren> lower{}, upper{};
};

// Bounds of F over the children of the cube at `middle` (mm, relative to the culling origin), whose edge is
// `child_side`, from the segments in `list`. Where F may reach the isovalue the upper bound says only that. `reaching`
// receives for each entry of the list one bit per child that the segment's support reaches.
ChildBounds cull_children(const ConvolutionField& field, const CullingSegments& culling,
                          std::span<const std::uint32_t> list, glm::vec3 middle, float child_side,
                          std::span<std::uint8_t> reaching);

} // namespace ramus::field
