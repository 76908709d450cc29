// Walls of a vessel in a reformation: the columns where the line of each picture row leaves the lumen on either side of
// the axis. They come from lumens (cross_section.h), or directly from a surface, which is many times faster and serves
// pictures that follow a slider.
//
// Guarantees: walls are exact for the triangles. Both ways give the same on closed surfaces. A row has no walls where
// the axis is outside of the lumen, and directly from a surface also where a wall lies beyond the picture.
// Not guaranteed: walls on surfaces with holes.
#pragma once

#include "core/base/box_tree.h"
#include "core/slice/reformation.h"

#include <functional>
#include <optional>
#include <vector>

namespace ramus::slice {

// Columns.
struct RowWalls {
    double left = 0.0, right = 0.0;
};
using Walls = std::vector<std::optional<RowWalls>>; // one for each row

// `lumens`: one for each row, of lumens_of_rows().
[[nodiscard]] Walls walls_of(const Reformation& picture, const std::vector<std::optional<Lumen>>& lumens);

// The line of a row, within the picture, in the plane of the row.
struct RowLine {
    Plane plane;
    glm::dvec3 from, to;
};
// Appends the pieces of the triangles that the plane cuts (cut_triangles()), at least of those that meet the line.
// Called from several threads.
using PiecesOnLine = std::function<void(const RowLine&, std::vector<CutTriangle>&)>;
[[nodiscard]] Walls walls_of(const Reformation& picture, const PiecesOnLine& pieces);

// The triangles of a mesh near lines. Refers to the mesh, which must not change.
class MeshLines {
public:
    explicit MeshLines(const mesh::TriangleMesh& mesh);
    void add_pieces(const RowLine& line, std::vector<CutTriangle>& pieces) const;

private:
    const mesh::TriangleMesh* mesh_;
    BoxTree boxes_; // around runs of triangles that follow each other
};

// Walls as polylines in columns and rows, interrupted where a row has none and where a wall jumps by more than
// `most_jump` columns from a row to the next, as at forks.
[[nodiscard]] std::vector<Outline> wall_lines(const Walls& walls, double most_jump);

} // namespace ramus::slice
