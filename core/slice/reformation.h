// Reformation: a picture along a vessel, a curved planar reformation. Each picture row is a straight line through the
// axis of the vessel; columns are equally spaced along it, `mm_per_pixel` apart in both directions.
//
// - Straightened: a row for each sample of the path. The row's line is at right angles to the axis, turned by the angle
//   about the axis against the frame of the path. Lengths along the axis and across it are true.
// - Stretched: all lines are parallel to one direction, the vector of interest. They sweep a surface through the axis,
//   which is curved in one direction only and is unrolled into the plane. So all lengths on the surface are true, and
//   the axis keeps its bends along the lines: a row's column is the coordinate along the vector, rows follow each other
//   by the axis's way at right angles to it. The vector is at right angles to the line from the path's start to the
//   sample farthest from it, turned about that line by the angle; at 0 it is the `right` of axes_across().
//
// Guarantees: along the axis the picture is an isometry up to the path's step. Pixels are sampled by sampled() at the
// places that the rows state. Not guaranteed: straightened pictures of the surroundings where a vessel bends more than
// the picture is wide; stretched pictures where the axis runs along the vector of interest (its rows collapse to one).
// Source: A. Kanitsar, D. Fleischmann, R. Wegenkittl, P. Felkel, E. Groeller, "CPR: curved planar reformation", IEEE
// Visualization 2002. Units: mm.
#pragma once

#include "core/slice/cross_section.h"
#include "core/slice/sample.h"
#include "core/slice/vessel_path.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::slice {

enum class ReformationKind : std::uint8_t { kStraightened, kStretched };
inline constexpr std::array<std::pair<ReformationKind, std::string_view>, 2> kReformations{
    {{ReformationKind::kStraightened, "straightened"}, {ReformationKind::kStretched, "stretched"}}};
[[nodiscard]] std::string_view name_of(ReformationKind kind);
[[nodiscard]] std::optional<ReformationKind> reformation_named(std::string_view name);

struct ReformationRow {
    glm::dvec3 first{0.0};           // place of the centre of column 0
    glm::dvec3 right{1.0, 0.0, 0.0}; // step from column to column
    glm::dvec3 normal{0.0};          // unit normal of the plane of the row's line, towards the end of the path
    double arc_mm = 0.0;             // of the axis, along the path
    double axis_column = 0.0;

    [[nodiscard]] glm::dvec3 place(double column) const { return first + column * right; }
    [[nodiscard]] glm::dvec3 axis() const { return place(axis_column); }
    [[nodiscard]] Plane plane() const { return {axis(), normal}; }
};

struct Reformation {
    ReformationKind kind = ReformationKind::kStraightened;
    double mm_per_pixel = 1.0; // the path's step
    int columns = 0;
    std::vector<ReformationRow> rows;
    std::vector<glm::dvec2> axis; // column and row of each sample of the path
};

// `width_mm`: of a straightened picture; of a stretched one the width to half of which it shows the surroundings beyond
// the axis on either side. Straightened pictures have an odd number of columns, the axis in the middle one.
[[nodiscard]] Reformation reformation_along(const VesselPath& path, ReformationKind kind, double angle_deg,
                                            double width_mm);

// The scan's values, row by row. A slab is across the picture. NaN outside of the scan.
[[nodiscard]] std::vector<float> sampled(const volume::Volume& volume, const Reformation& picture,
                                         const Sampling& sampling = {});

// The lumen in the plane of each row, for walls (walls.h). For straightened pictures those of lumens_along(), whatever
// the angle, so that a caller can keep them.
[[nodiscard]] std::vector<std::optional<Lumen>> lumens_of_rows(const Reformation& picture, const LoopsOfPlane& loops);

// The place that a pixel shows, and that of the axis in its row. Rows between whole numbers are interpolated.
struct PicturePlace {
    glm::dvec3 at{0.0};
    double arc_mm = 0.0;    // along the path
    double across_mm = 0.0; // from the axis, positive to the right
};
// None beyond the outermost pixels' centres by more than half a pixel.
[[nodiscard]] std::optional<PicturePlace> place_of(const Reformation& picture, const glm::dvec2& pixel);
// The column and row that show a point of the axis; `arc_mm` is clamped to the path.
[[nodiscard]] glm::dvec2 pixel_of(const Reformation& picture, const VesselPath& path, double arc_mm);

} // namespace ramus::slice
