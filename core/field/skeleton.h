// Skeleton: the line segments of a field with their radii, and the box around the field. A value: copies share the
// segments, and a copy without some branches costs a list of indices.
#pragma once

#include "core/field/cut_ends.h"
#include "core/tree/prepare.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ramus::field {

// A line segment with linear radius. The start is in double precision; the rest is relative, so single precision is
// enough. The size is one cache line, since samples use segments from all over the tree.
//
// Beyond an end with radius r, at x mm along the axis, the radius is r + slope x E / (|x| + E) with E = beyond r. So
// the slope of the radius, and with it the gradient of the field, does not jump at the end, and a cone cut in two keeps
// its shape. With beyond = 0 the radius stays r, as in the paper.
//
// The radius is the kernel's (kernel_radii.h); `excess` is the tree's radius minus the kernel's.
struct alignas(64) FieldSegment {
    double ax, ay, az;           // start point, mm
    float ux, uy, uz;            // unit direction
    float length, radius, slope; // mm, mm at the start, radius change per mm
    float beyond;
    std::int32_t branch;                      // id in the source tree
    float excess = 0.0F, excess_slope = 0.0F; // mm at the start, change per mm

    [[nodiscard]] float end_radius() const { return radius + slope * length; }
    // The tree's radius at `along` mm from the start.
    [[nodiscard]] float tree_radius(float along) const { return radius + excess + (slope + excess_slope) * along; }
    // The largest radius at the foot of any point, beyond the ends included.
    [[nodiscard]] float thickest() const {
        return slope > 0.0F ? end_radius() * (1.0F + slope * beyond) : radius * (1.0F - slope * beyond);
    }
    bool operator==(const FieldSegment&) const = default;
};

// FieldSegment::beyond for a slope of the radius: smaller for steep slopes, as where a twig begins with the radius of
// its stem. The radius changes by at most 0.066 of itself beyond an end (where 32 slope^2 = 1).
[[nodiscard]] double beyond_for(double slope);

// The box around a field and its thinnest radius, from which lattices are derived. A field and parts of it share one
// extent, so that their common parts have the same bits.
struct Extent {
    glm::dvec3 lower{0.0}, upper{0.0}; // box around all supports, mm
    double thinnest = 0.0;             // smallest radius, mm
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (lower + upper); }
    bool operator==(const Extent&) const = default;
};

// The segments in which two states of a field differ, as indices into the earlier state and into the later one,
// ascending.
struct SegmentChanges {
    std::vector<std::uint32_t> before, after;
};

class Skeleton {
public:
    // `support_radii`: how far the field of a segment reaches, in local radii.
    Skeleton(const tree::PreparedTree& prepared, double support_radii);
    // With the extent of a larger tree.
    Skeleton(const tree::PreparedTree& prepared, double support_radii, const Extent& extent);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] Skeleton without(std::span<const std::uint8_t> hidden) const;

    // All segments, by index in the file's tree. Only the segments in present() belong to the field.
    [[nodiscard]] const std::vector<FieldSegment>& segments() const { return *segments_; }
    [[nodiscard]] const std::vector<std::uint32_t>& present() const { return present_; } // ascending
    // Ends with a flat cap; their segments are extended beyond the cap (core/field/cut_ends.h).
    [[nodiscard]] const std::vector<CutEnd>& cut_ends() const { return *cut_ends_; }
    [[nodiscard]] const Extent& extent() const { return extent_; }
    // The differences from an earlier state; nothing if the two have different extents or numbers of segments.
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const Skeleton& before) const;

private:
    std::shared_ptr<const std::vector<FieldSegment>> segments_;
    std::shared_ptr<const std::vector<CutEnd>> cut_ends_;
    std::vector<std::uint32_t> present_;
    Extent extent_;
};

} // namespace ramus::field
