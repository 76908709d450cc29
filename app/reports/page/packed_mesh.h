// Packs a surface for pages: positions on a grid, triangles one after the other across a shared edge, so that most of
// them take a byte or less and most vertices a small correction. assets/page/decode.js reads it.
//
// Triangles keep their order and their winding; their corners are rotated. Vertices are numbered by their first use.
// The grid is finer for groups of triangles (branches) that are thin: by a power of two of `step_mm`. A vertex lies on
// the grid of the first group that uses it, so that groups still share vertices.
//
// Prediction of a vertex across an edge: C. Touma and C. Gotsman, "Triangle mesh compression" (Graphics Interface
// 1998). A short list of recent edges and vertices, as in meshoptimizer's index codec (A. Kapoulkine).
#pragma once

#include "app/reports/page/branch_surface.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

struct GridChoice {
    double most_mm = 0.02;        // no step is wider
    double share_of_radius = 0.0; // of the thinnest vessel of a group, 1 / 100; 0: all groups have the widest step
};

struct PackedMesh {
    glm::dvec3 origin{0.0};      // mm, of the grid
    double step_mm = 0.0;        // the finest step
    double widest_step_mm = 0.0; // of any group
    std::size_t vertices = 0, triangles = 0;
    // Each by itself is compressed (zlib).
    std::string counts;      // by group: number of triangles, 4 bytes each, low byte first
    std::string shifts;      // by group: log2(its step / step_mm)
    std::string gates;       // one byte for a triangle across a recent edge, two for others
    std::string extras;      // numbers of vertices that are not among the recent ones
    std::string corrections; // by vertex: x, y, z, three bytes each; byte 0 of all x, byte 0 of all y, ...
    // Fewer triangles of the same vertices, for while the view moves; empty: none.
    std::size_t coarse_triangles = 0;
    std::string coarse_counts, coarse_gates, coarse_extras;
    std::vector<glm::vec3> places; // by vertex of the surface, mm: on the grid, as the page has it
    [[nodiscard]] std::size_t bytes() const {
        return counts.size() + shifts.size() + gates.size() + extras.size() + corrections.size() +
               coarse_counts.size() + coarse_gates.size() + coarse_extras.size();
    }
};

// `coarse`: triangles of the same vertices, for each group; may be empty.
[[nodiscard]] PackedMesh packed(const BranchSurface& surface, const BranchSurface& coarse, const GridChoice& grid);

// zlib format (RFC 1950), which the browser's DecompressionStream("deflate") reads.
[[nodiscard]] std::string deflated(std::span<const std::uint8_t> bytes);

} // namespace ramus::app
