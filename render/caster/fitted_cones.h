// FittedCones: round cones along centerlines that lie where the surface does, and which vessels go on into which. For
// large trees they take a while: any thread may make them. Immutable from then on, and shared between pictures.
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

// By point: the first one at the same position. Only ends of branches can share one.
[[nodiscard]] std::vector<std::uint32_t> coincident_points(const Centerlines& lines);

// Of segment s: segments[first[s]] to segments[first[s + 1] - 1], itself first; an even number, made so by one that
// there is not (their count).
struct Neighbours {
    std::vector<std::uint32_t> first, segments;
};

// `coincident`: coincident_points() of the lines. `points`: the first point of each segment, which ends at the next
// one. Segments are joined where they have a point in common and where their points coincide. `support_radii`: how far
// a segment's kernel reaches, in radii. Vessels that pass close by without being joined there are not found.
[[nodiscard]] Neighbours find_neighbours(const Centerlines& lines, std::span<const std::uint32_t> coincident,
                                         std::span<const std::uint32_t> points, float support_radii);

// Of centerlines that are cast before there is a surface; of more, what the caster begins with takes too long.
inline constexpr std::size_t kMostCastPoints = 300'000;

struct FittedCones {
    struct Segment {
        std::uint32_t point; // and the next one
        std::int32_t branch;
        // Points that the vessel comes from and goes on to; or one of these.
        static constexpr std::uint32_t kFree = ~0U, kJoins = ~0U - 1; // ends here; goes into another vessel here
        std::uint32_t previous, next;
    };

    std::shared_ptr<const Centerlines> lines; // that they are of
    float width = 0.0F, beyond_ends = 0.0F;   // as in Frame
    Centerlines thinned;                      // with the points that cones join
    // By point of those: the ball around it that is nearest to the surface; and where the point itself is.
    std::vector<glm::vec4> fitted, on_line;
    // By segment; what the field reads has one more, which is nowhere.
    std::vector<Segment> segments;
    std::vector<std::uint32_t> segment_branches;
    Neighbours neighbours;
    float neighbours_width = 0.0F; // of the kernel that those are for; 0: of none, the surface is the cones

    [[nodiscard]] FieldSegment field_segment(const Segment& segment, const glm::mat4& to_eye) const;
};

// `width`, `beyond_ends`: of the surface, as Frame has them. `lines` may be null: then there are none.
[[nodiscard]] std::shared_ptr<const FittedCones> fitted_cones(std::shared_ptr<const Centerlines> lines, float width,
                                                              float beyond_ends);

// The steps of that.
void find_joints(FittedCones& cones, std::span<const std::uint32_t> coincident);
void fit_balls(FittedCones& cones); // needs the neighbours, where there are any

} // namespace ramus::render::caster
