// Centerlines: where the vessels' middles run, for lines inside glass and for what is asked of a point along a branch:
// how wide the vessel is there, how far from the root, before or behind a cut. Branches have the ids of the surface. An
// immutable value, shared between frames; positions are single precision relative to `origin`.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace ramus::render {

inline constexpr float kCenterlineWidth = 1.6F; // of lines inside glass, points

struct Centerlines {
    struct Detail {
        float diameter_mm;
        std::int32_t branch;
        bool operator==(const Detail&) const = default;
    };
    struct Run {
        std::uint32_t first = 0, count = 0; // points
        bool operator==(const Run&) const = default;
    };

    std::vector<glm::vec4> points; // mm relative to origin; w: mm from the root along the tree
    std::vector<Detail> details;   // of the same points
    // Numbers of the same points that colours may show, kNotKnown where there is none. thinned() leaves them out.
    std::vector<std::vector<float>> lists;
    std::vector<Run> runs;     // by branch id, from the parent's end outward; a branch without a position has no point
    glm::dvec3 origin{0.0};    // mm
    bool smooth_radii = false; // whether radii go on beyond the ends of segments (core/field/skeleton.h)

    // From corner to corner of the box around the points; 0 without any.
    [[nodiscard]] double extent_mm() const;
    // The same with fewer points: each branch's line and its radius go no farther from these than a share of the radius
    // and than `most_mm`.
    static constexpr double kThinnedRadii = 0.15; // tuned by eye
    [[nodiscard]] Centerlines thinned(double most_mm, double most_radii = kThinnedRadii) const;

    // A point of a branch, `fraction` of its length from the parent's end; nothing where the branch has no points.
    struct BranchPoint {
        glm::dvec3 position{0.0}, along{0.0, 0.0, 1.0}; // mm; unit vector away from the root
        double from_root_mm = 0.0, radius_mm = 0.0;
    };
    [[nodiscard]] std::optional<BranchPoint> at(int branch, double fraction) const;
};

} // namespace ramus::render
