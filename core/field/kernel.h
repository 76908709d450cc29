// Kernel: what one segment adds to a field around it, as a value: constants, and the functions that are compiled for
// it.
//
// A kernel is written as a struct of vector operations, its profile (see kernels/gaussian-inl.h). plain_sum()
// (sum/plain_sum-inl.h) makes of a profile all that summing it over segments takes, once for each instruction set. So a
// kernel is one pair of files under kernels/ and a row of kernels/kernel_kind.cpp; nothing else knows about it.
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

// What culling reads of a segment, in single precision relative to one origin, side by side in memory.
struct CullingSegment {
    float ax, ay, az, ux, uy, uz;
    float length, radius, slope, beyond;
    float thickest; // as FieldSegment::thickest()
};

// Which segments to evaluate: kAllSegments takes every one everywhere, which gives the same values and measures what
// choosing saves.
enum class Choice { kReaching, kAllSegments };

// Some segments as seen from one point, and what each adds to the field there: rows of numbers, one for each segment.
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
        kGradientZ, // what it adds
        kRows
    };
    std::size_t count = 0;

    [[nodiscard]] float* row(Numbers numbers) { return numbers_.data() + numbers * stride_; }
    [[nodiscard]] const float* row(Numbers numbers) const { return numbers_.data() + numbers * stride_; }
    // Begins anew, with room for so many.
    void clear(std::size_t most);
    void add(const FieldSegment& segment);
    // Says from where all of them are seen, mm.
    void see_from(const glm::dvec3& point);

private:
    std::size_t stride_ = 0;
    std::vector<float> numbers_;
    std::array<std::vector<double>, 3> starts_; // by axis, mm
};

// A sum of one kernel, for one instruction set. As in FieldModel (field.h).
struct PlainSum {
    const char* instruction_set; // such as "AVX3"
    std::unique_ptr<BrickField> (*in_brick)(const Kernel& kernel, const FieldSegment* segments, Choice choice);
    ChildBounds (*bound_children)(const Kernel& kernel, const CullingSegment* segments, SegmentIndices list,
                                  const ChildCubes& cubes, std::span<std::uint8_t> reaching);
    void (*find_terms)(const Kernel& kernel, SegmentTerms& terms);
};

// What an endless straight vessel makes of a kernel's field, by the distance from its axis in radii; of one kernel.
struct LongVessel {
    double (*value)(const Kernel& kernel, double radii2); // of the squared distance: 1 on the axis, the isovalue at 1
    // From a value of the field, wherever it was found: a measure of how far out that is, nearly linear in the
    // distance, and what the value falls by where the measure grows.
    struct Place {
        double measure, fall;
    };
    Place (*place)(const Kernel& kernel, double value);
};

struct Kernel {
    double width = 0.0; // how steep: the larger, the closer the surface stays to the radius where vessels meet
    double isovalue = 0.0;
    // In local radii: the distance from a segment at which the kernel has faded to exactly zero, and the distance from
    // an end, along the axis, beyond which that end changes nothing to the last bit.
    double support_radii = 0.0, ends_radii = 0.0;
    const PlainSum* sum = nullptr; // of the instruction set in use when the kernel was made
    const LongVessel* long_vessel = nullptr;
    // At which closenesses its vessels meet; and how many radii from its axis no point is inside a vessel, four of
    // whose kind meet there.
    tree::ContactLimits limits;
    double claim_radii = 0.0;
    std::array<double, 8> numbers{}; // whatever else its profile is made of

    bool operator==(const Kernel&) const = default;
};

// The distance from a long vessel's axis, in radii, at which its field is `value`.
[[nodiscard]] double radii_at(const Kernel& kernel, double value);

// Fills in limits and claim_radii from the rest: two parallel vessels merge where each adds half the isovalue between
// them, four where each adds a quarter, and one changes nothing at the other's surface where its support has ended.
void find_reaches(Kernel& kernel);

} // namespace ramus::field
