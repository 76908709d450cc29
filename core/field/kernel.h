// Kernel: what one segment adds to a field around it, as a value: constants, and the functions that are compiled for
// it.
//
// A kernel is written as a struct of vector operations, its profile (see kernels/gaussian-inl.h). kPlainSumFunctions
// (sum/plain_sum-inl.h) makes of a profile all that summing it over segments takes, once for each instruction set. So a
// kernel is one pair of files under kernels/, and nothing else knows about it.
#pragma once

#include "core/field/child_bounds.h"
#include "core/field/projection.h"
#include "core/field/samples.h"

#include <cstdint>
#include <span>

namespace ramus::field {

struct Kernel;
struct LocalSegments;

// What culling reads of a segment, in single precision relative to one origin, side by side in memory.
struct CullingSegment {
    float ax, ay, az, ux, uy, uz;
    float length, radius, slope;
};

// Which segments to evaluate: kAllSegments takes every one everywhere, which gives the same values and measures what
// choosing saves.
enum class Choice { kReaching, kAllSegments };

// The steps in which a sum of one kernel is used, for one instruction set. As in FieldInBrick and FieldModel
// (field.h).
struct KernelFunctions {
    std::uint64_t (*sample_groups)(LocalSegments& local, unsigned groups, GridGroups& samples, Choice choice);
    std::uint64_t (*sample_lattice)(LocalSegments& local, const LatticeAxes& axes, std::span<const LatticePoint> points,
                                    std::span<float> values);
    std::uint64_t (*project)(LocalSegments& local, const Projection& guesses, const SurfacePoints& to);
    void (*find_depths)(const Kernel& kernel, const GridValues& values, GridValues& depths);
    float (*crossing)(const Kernel& kernel, float from, float to);
    ChildBounds (*bound_children)(const Kernel& kernel, const CullingSegment* segments,
                                  std::span<const std::uint32_t> list, const ChildCubes& cubes,
                                  std::span<std::uint8_t> reaching);
};

struct Kernel {
    double width = 0.0; // how steep: the larger, the closer the surface stays to the radius where vessels meet
    double isovalue = 0.0;
    // In local radii: the distance from a segment at which the kernel has faded to exactly zero, and the distance from
    // an end, along the axis, beyond which that end changes nothing to the last bit.
    double support_radii = 0.0, ends_radii = 0.0;
    const KernelFunctions* functions = nullptr; // of the instruction set in use when the kernel was made

    bool operator==(const Kernel&) const = default;
};

} // namespace ramus::field
