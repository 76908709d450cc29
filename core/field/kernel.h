// Kernel: the contribution of one segment to the field, as a value: constants, and pointers to compiled functions.
//
// A kernel is implemented as a struct of vector operations, its profile (see kernels/gaussian-inl.h). plain_sum()
// (sum/plain_sum-inl.h) turns a profile into the functions that evaluate sums over segments, once for each instruction
// set. So a kernel is a pair of files in kernels/ and a row of kernels/kernel_kind.cpp.
#pragma once

#include "core/field/brick_field.h"
#include "core/field/skeleton.h"
#include "core/tree/contacts/contacts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace ramus::field {

struct Kernel;

// The data of a segment that culling needs, in single precision relative to the middle of the field's extent, mm.
struct CullingSegment {
    float ax, ay, az, ux, uy, uz;
    float length, radius, slope, beyond;
    float thickest; // as FieldSegment::thickest()
};

// Which segments to evaluate at a point. kAllSegments gives the same values as kReaching; benchmarks use it to measure
// how much the choice of reaching segments saves.
enum class Choice { kReaching, kAllSegments };

// The contributions of several segments at one point, as a structure of arrays: rows of numbers, a column per segment.
struct SegmentTerms {
    enum Numbers : std::uint8_t {
        kX,
        kY,
        kZ, // the point relative to the segment's start, mm
        kUx,
        kUy,
        kUz,
        kLength,
        kRadius,
        kSlope,
        kBeyond, // as in FieldSegment
        kValue,
        kGradientX,
        kGradientY,
        kGradientZ, // the contribution: value, and gradient per mm
        kRows
    };
    std::size_t count = 0;

    [[nodiscard]] float* row(Numbers numbers) { return numbers_.data() + numbers * stride_; }
    [[nodiscard]] const float* row(Numbers numbers) const { return numbers_.data() + numbers * stride_; }
    // Removes all segments, and allocates room for `most`.
    void clear(std::size_t most);
    void add(const FieldSegment& segment);
    // Sets the point (mm) for all segments.
    void see_from(const glm::dvec3& point);

private:
    std::size_t stride_ = 0;
    std::vector<float> numbers_;
    std::array<std::vector<double>, 3> starts_; // by axis, mm
};

// The functions that evaluate the sum of one kernel, compiled for one instruction set. FieldModel (field.h) describes
// in_brick() and bound_children(). find_terms() fills in values and gradients.
struct PlainSum {
    const char* instruction_set; // such as "AVX3"
    std::unique_ptr<BrickField> (*in_brick)(const Kernel& kernel, const FieldSegment* segments, Choice choice);
    ChildBounds (*bound_children)(const Kernel& kernel, const CullingSegment* segments, SegmentIndices list,
                                  const ChildCubes& cubes, std::span<std::uint8_t> reaching);
    void (*find_terms)(const Kernel& kernel, SegmentTerms& terms);
};

// The field of an infinitely long straight vessel, as a function of the distance from its axis in radii.
struct LongVessel {
    double (*value)(const Kernel& kernel, double radii2); // at a squared distance; 1 on the axis, the isovalue at 1
    // For a value of the field: a measure that is nearly linear in the distance from the axis, and the amount by which
    // the value falls per unit of the measure.
    struct Place {
        double measure, fall;
    };
    Place (*place)(const Kernel& kernel, double value);
};

struct Kernel {
    double width = 0.0; // the steepness: with a larger width the surface stays closer to the radii where vessels meet
    double isovalue = 0.0;
    // In local radii: the distance from a segment at which the kernel is exactly zero; and the distance from an end,
    // along the axis, beyond which the end does not change the value, to the last bit.
    double support_radii = 0.0, ends_radii = 0.0;
    const PlainSum* sum = nullptr; // for the instruction set in use when the kernel was made
    const LongVessel* long_vessel = nullptr;
    // The closenesses at which vessels merge; and the distance from a vessel's axis, in radii, beyond which the vessel
    // claims no point (core/field/separation).
    tree::ContactLimits limits;
    double claim_radii = 0.0;
    std::array<double, 8> numbers{}; // further constants of the profile

    bool operator==(const Kernel&) const = default;
};

// The distance from a long vessel's axis, in radii, at which its field is `value`.
[[nodiscard]] double radii_at(const Kernel& kernel, double value);

// Computes `limits` and `claim_radii` from the other members: two parallel vessels merge if each contributes half of
// the isovalue midway, four if each contributes a quarter; a vessel does not change a surface beyond its support.
void find_reaches(Kernel& kernel);

} // namespace ramus::field
