// Bounding volumes of segments: in which points a segment is evaluated, as geometry and as the cells of a grid whose
// centre they cover. The paper's figure 4 is about boxes and cylinders; the last one is what ramus has instead.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace ramus::app::paper {

enum class Bound {
    kBox,      // along the axes of the grid, around balls of the reach
    kCylinder, // along the segment and as far beyond its ends as the reach: the paper's
    kSupport,  // all that is nearer to the segment than the reach: where the fading kernel of ramus is not 0
};

struct BoundRow {
    Bound bound;
    std::string_view name;
    double reach_radii;
};
inline constexpr double kPaperReach = 1.5; // radii
// In the order of `Bound`.
[[nodiscard]] const std::array<BoundRow, 3>& bounds_of_segments();

// A segment of constant radius; mm.
struct RoundSegment {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 1.0;
};
[[nodiscard]] std::vector<RoundSegment> segments_of(const tree::VesselTree& tree); // radius: of its first point

[[nodiscard]] bool covers(const BoundRow& row, const RoundSegment& segment, const glm::dvec3& point);
[[nodiscard]] double volume_mm3(const BoundRow& row, const RoundSegment& segment); // in closed form

// Cells of a grid through the origin, by their centre.
struct CoveredCells {
    std::vector<glm::ivec3> cells; // each once, that some segment covers
    std::size_t evaluations = 0;   // over all segments the cells of each
};
[[nodiscard]] CoveredCells covered_cells(const BoundRow& row, const std::vector<RoundSegment>& segments,
                                         double cell_mm);

// As triangles: the volume of one segment, and cells as cubes with a gap between them.
[[nodiscard]] mesh::TriangleMesh shape_of(const BoundRow& row, const RoundSegment& segment);
[[nodiscard]] mesh::TriangleMesh cubes_of(const std::vector<glm::ivec3>& cells, double cell_mm);

} // namespace ramus::app::paper
