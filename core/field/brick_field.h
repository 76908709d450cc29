// BrickField: a field in one brick of the octree after another, with the memory that this takes. What a model of
// field.h computes there is compiled as a whole (vectorised, per kernel and instruction set): a call costs one
// indirection, for some hundred points or more.
#pragma once

#include "core/field/projection.h"
#include "core/field/samples.h"

#include <cstdint>
#include <span>

namespace ramus::field {

using SegmentIndices = std::span<const std::uint32_t>; // ascending

// Counts returned: kernels evaluated, one for each segment and point.
class BrickField {
public:
    virtual ~BrickField() = default;
    // Begins a brick: the segments that reach it, which must outlive the stay, and the coordinates of its grid points.
    virtual void enter(SegmentIndices list, const GridAxes& axes) = 0;
    // Values at the groups of grid points that have their bits set.
    virtual std::uint64_t sample_groups(unsigned groups, GridGroups& samples) = 0;
    // Values at points of a finer lattice with the same corner in the same box.
    virtual std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                         std::span<float> values) = 0;
    // Moves points onto the surface. Each stays within its reach.
    virtual std::uint64_t project(Projection& guesses, const SurfacePoints& to) = 0;
    // From values to numbers that are nearly linear in the distance from the surface: 0 or more exactly where the value
    // is at or above the isovalue, less outside.
    virtual void find_depths(const GridValues& values, GridValues& depths) const = 0;
    // The share of the way along an edge, from a value on one side of the isovalue to one on the other, at which the
    // surface crosses it.
    [[nodiscard]] virtual float crossing(float from, float to) const = 0;
};

} // namespace ramus::field
