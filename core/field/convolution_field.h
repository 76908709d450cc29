// ConvolutionField: the scalar field F(p) = sum_i h_i(p) of a vessel tree after Oeltze & Preim (2005), eqs. 7-10, ready
// to be sampled. It owns the segments and the constants of the kernel.
//
// The kernel of a segment a -> b of length L with unit direction u, radii linear between its ends, w = width ln 2:
//     t = (p - a) . u,   d = distance of p to the line,   r = radius at clamp(t, 0, L)
//     h(p) = S(rho) exp(-w d^2 / r^2) * 1/2 [erf(sqrt(w) t / r) + erf(sqrt(w) (L - t) / r)]
// and the surface is F = exp(-w). S fades the kernel smoothly to exactly zero between 1.4 and 1.7 radii (times
// sqrt(5 / width)) from the segment, so that distant segments can be left out without a trace.
#pragma once

#include "core/tree/prepared_tree.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace ramus::field {

// Constants of the kernel. Distances enter it only as multiples of r / sqrt(w), so that the fade sits at the same
// numbers whatever the width: w (1.4 sqrt(5 / width))^2 = 5 ln 2 1.4^2.
struct Kernel {
    double w = 0.0;
    double sqrt_w = 0.0;
    double root_width = 0.0;
    double isovalue = 0.0;
    double support_radii = 0.0; // distance from a segment, in local radii, at which the kernel has faded to zero

    explicit Kernel(double width);
};

inline constexpr double kFadeBegin = 6.792841769487465; // 5 ln 2 1.4^2
inline constexpr double kFadeEnd = 10.016026079703457;  // 5 ln 2 1.7^2

// A line segment with linear radius. Its start stays in double precision; all else is relative and fits in single
// precision. One cache line, since samples take segments from all over the tree.
struct alignas(64) FieldSegment {
    double ax, ay, az;           // start point, mm
    float ux, uy, uz;            // unit direction
    float length, radius, slope; // mm, mm at the start, radius change per mm
    std::int32_t branch;         // id in the source tree

    [[nodiscard]] float end_radius() const { return radius + slope * length; }
};

// The space that a field is in, and its finest feature. What lattices are laid out by; a field and parts of it share
// one, so that what they have in common is the same to the last bit.
struct Frame {
    glm::dvec3 lower{0.0}, upper{0.0}; // box around all supports, mm
    double thinnest = 0.0;             // smallest radius, mm
    bool operator==(const Frame&) const = default;
};

// How far the surface of a long vessel reaches beyond its free end, in radii: where 1/2 [1 - erf(sqrt(w) x)] is the
// isovalue exp(-w). 0.70752 at width 5, nothing at width 1. `width`: 1 or more.
[[nodiscard]] double reach_beyond_end(double width);

class ConvolutionField {
public:
    ConvolutionField(const tree::PreparedTree& prepared, double width);
    // In a frame that is that of a larger tree.
    ConvolutionField(const tree::PreparedTree& prepared, double width, const Frame& frame);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] ConvolutionField without(std::span<const std::uint8_t> hidden) const;

    // By place in the file's tree; only those in present() count.
    [[nodiscard]] const std::vector<FieldSegment>& segments() const { return *segments_; }
    [[nodiscard]] const std::vector<std::uint32_t>& present() const { return present_; } // ascending
    [[nodiscard]] const Kernel& kernel() const { return kernel_; }
    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] glm::dvec3 lower() const { return frame_.lower; }
    [[nodiscard]] glm::dvec3 upper() const { return frame_.upper; }
    // Whether both have the same segments, present or not, without looking at each.
    [[nodiscard]] bool shares_segments(const ConvolutionField& other) const { return segments_ == other.segments_; }

private:
    Kernel kernel_;
    std::shared_ptr<const std::vector<FieldSegment>> segments_;
    std::vector<std::uint32_t> present_;
    Frame frame_;
};

} // namespace ramus::field
