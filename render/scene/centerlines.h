// Centerlines: the centerlines of all branches, for drawing lines and for properties along a branch (diameter, distance
// from the root, position relative to a cut). Branches have the ids of the surface. An immutable value, shared between
// frames; positions are single precision, in mm relative to `origin`.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace ramus::render {

inline constexpr float kCenterlineWidth = 1.6F; // line width inside glass, points

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
    // Values at the same points, for colouring; kNotKnown if missing. thinned() omits them.
    std::vector<std::vector<float>> lists;
    std::vector<Run> runs;     // by branch id, from the parent's end outward; may be empty
    glm::dvec3 origin{0.0};    // mm
    bool smooth_radii = false; // radii continue smoothly across segments (core/field/skeleton.h)

    // Diagonal of the bounding box of the points; 0 without points.
    [[nodiscard]] double extent_mm() const;
    // Simplifies: the lines and radii of branches deviate by at most `most_radii` times the radius, and at most
    // `most_mm`.
    static constexpr double kThinnedRadii = 0.15; // tuned by eye
    [[nodiscard]] Centerlines thinned(double most_mm, double most_radii = kThinnedRadii) const;

    // The point of a branch at `fraction` of its length from the parent's end; none if the branch has no points.
    struct BranchPoint {
        glm::dvec3 position{0.0}, along{0.0, 0.0, 1.0}; // mm; unit vector away from the root
        double from_root_mm = 0.0, radius_mm = 0.0;
    };
    [[nodiscard]] std::optional<BranchPoint> at(int branch, double fraction) const;
};

} // namespace ramus::render
