// FittedCones: round cones along centerlines, fitted to the convolution surface, and how vessels continue at their
// ends. Lengths in mm. Building them takes a while for large trees; any thread may do it. They are immutable afterwards
// and shared between pictures.
#pragma once

#include "render/caster/cast_types.h"
#include "render/scene/centerlines.h"

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

namespace ramus::render::caster {

// Which segments of a tree add to the field on each other's surface: found along the tree, once for all pictures.

// For each point: the first point at the same position. Only ends of branches can coincide.
[[nodiscard]] std::vector<std::uint32_t> coincident_points(const Centerlines& lines);

// For each segment, the segments that contribute to the field on its surface: segments[first[s]] to segments[first[s +
// 1] - 1], the segment itself first. Their number is even; where necessary, the index of a segment that does not exist
// (the number of segments) fills up.
struct Neighbours {
    std::vector<std::uint32_t> first, segments;
};

// Searches along the tree, once for all pictures. `coincident`: coincident_points() of the lines. `points`: the first
// point of each segment; the segment ends at the next point. Segments are connected where they share a point or where
// their points coincide. `support_radii`: the reach of a segment's kernel, in radii. Does not find vessels that pass
// close by without being connected there.
[[nodiscard]] Neighbours find_neighbours(const Centerlines& lines, std::span<const std::uint32_t> coincident,
                                         std::span<const std::uint32_t> points, float support_radii);

// Largest number of points of centerlines that are cast before a surface exists. For more, building the cones takes too
// long.
inline constexpr std::size_t kMostCastPoints = 300'000;

struct FittedCones {
    struct Segment {
        std::uint32_t point; // start; the next point is the end
        std::int32_t branch;
        // The points before and after the segment on the vessel, or one of these.
        static constexpr std::uint32_t kFree = ~0U, kJoins = ~0U - 1; // free end; joins another vessel
        std::uint32_t previous, next;
    };

    std::shared_ptr<const Centerlines> lines; // the input
    float width = 0.0F, beyond_ends = 0.0F;   // as in Frame
    Centerlines thinned;                      // only the points that cones connect
    // For each point of `thinned`: the ball that fits the surface best, and the point itself with its radius.
    std::vector<glm::vec4> fitted, on_line;
    // By segment. The arrays for the field have one more entry, a segment far away from everything (see Neighbours).
    std::vector<Segment> segments;
    std::vector<std::uint32_t> segment_branches;
    Neighbours neighbours;
    float neighbours_width = 0.0F; // kernel width they were computed for; 0: none, the cones are the surface

    [[nodiscard]] FieldSegment field_segment(const Segment& segment, const glm::mat4& to_eye) const;
};

// Thread-safe. `width`, `beyond_ends`: as in Frame. `lines` may be null; the result is null then, too.
[[nodiscard]] std::shared_ptr<const FittedCones> fitted_cones(std::shared_ptr<const Centerlines> lines, float width,
                                                              float beyond_ends);

// The steps of fitted_cones().
void find_joints(FittedCones& cones, std::span<const std::uint32_t> coincident);
void fit_balls(FittedCones& cones); // needs the neighbours, where there are any

} // namespace ramus::render::caster
