// Skeleton: the line segments that a field is made of, with their radii, and the space that they are in. A value:
// copies share the segments, and a copy without some branches costs a list of indices.
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

// A line segment with linear radius. Its start stays in double precision; all else is relative and fits in single
// precision. One cache line, since samples take segments from all over the tree.
//
// Beyond an end, at x mm along the axis, the radius goes on from the end's radius r as r + slope x E / (|x| + E) with
// E = beyond r: its slope does not jump there, so that the field's gradient does not either, and a cone cut in two
// stays the cone that it was. With beyond = 0 it stays r, as in the paper.
//
// The tree's radius may be another one than the kernel's (kernel_radii.h); `excess` is what it has more.
struct alignas(64) FieldSegment {
    double ax, ay, az;           // start point, mm
    float ux, uy, uz;            // unit direction
    float length, radius, slope; // mm, mm at the start, radius change per mm
    float beyond;
    std::int32_t branch;                      // id in the source tree
    float excess = 0.0F, excess_slope = 0.0F; // mm at the start, change per mm

    [[nodiscard]] float end_radius() const { return radius + slope * length; }
    // The tree's radius so many mm along.
    [[nodiscard]] float tree_radius(float along) const { return radius + excess + (slope + excess_slope) * along; }
    // The largest radius that any point sees, and the smallest.
    [[nodiscard]] float thickest() const {
        return slope > 0.0F ? end_radius() * (1.0F + slope * beyond) : radius * (1.0F - slope * beyond);
    }
    bool operator==(const FieldSegment&) const = default;
};

// How far `beyond` lets radii go on, by the slope: less where it is steep, as where a twig begins with the radius of
// its stem. The radius changes by 0.066 of itself at the most, where 32 slope^2 = 1.
[[nodiscard]] double beyond_for(double slope);

// The space that a field is in, and its finest feature. What lattices are laid out by; a field and parts of it share
// one, so that what they have in common is the same to the last bit.
struct Frame {
    glm::dvec3 lower{0.0}, upper{0.0}; // box around all supports, mm
    double thinnest = 0.0;             // smallest radius, mm
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (lower + upper); }
    bool operator==(const Frame&) const = default;
};

// Segment indices in which two states of a field differ, ascending: of the earlier state, and of the later one.
struct SegmentChanges {
    std::vector<std::uint32_t> before, after;
};

class Skeleton {
public:
    // `support_radii`: how far from a segment the field reaches, in the segment's radii.
    Skeleton(const tree::PreparedTree& prepared, double support_radii);
    // In the frame of a larger tree.
    Skeleton(const tree::PreparedTree& prepared, double support_radii, const Frame& frame);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] Skeleton without(std::span<const std::uint8_t> hidden) const;

    // By segment index in the file's tree; only those in present() count.
    [[nodiscard]] const std::vector<FieldSegment>& segments() const { return *segments_; }
    [[nodiscard]] const std::vector<std::uint32_t>& present() const { return present_; } // ascending
    // Ends that the surface is flat at; their segments go on beyond (core/field/cut_ends.h).
    [[nodiscard]] const std::vector<CutEnd>& cut_ends() const { return *cut_ends_; }
    [[nodiscard]] const Frame& frame() const { return frame_; }
    // What is not the same in an earlier state; nothing when the two have different frames or numbers of segments.
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const Skeleton& before) const;

private:
    std::shared_ptr<const std::vector<FieldSegment>> segments_;
    std::shared_ptr<const std::vector<CutEnd>> cut_ends_;
    std::vector<std::uint32_t> present_;
    Frame frame_;
};

} // namespace ramus::field
