#include "core/slice/walls.h"

#include "core/base/infinity.h"
#include "core/mesh/line_box.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <span>

namespace ramus::slice {

namespace {

constexpr std::size_t kRun = 64; // tuned: triangles in a box

// The crossings of a line in a plane with pieces of outlines, next to a point of the line on either side.
class Crossings {
public:
    // `along`: of unit length. Crossings beyond `least` and `most` do not count.
    Crossings(const ReformationRow& row, double least, double most)
        : at_(row.axis()), along_(glm::normalize(row.right)), aside_(glm::cross(row.normal, along_)), left_(least),
          right_(most) {}

    void add(const glm::dvec3& from, const glm::dvec3& to) {
        const double a = glm::dot(from - at_, aside_), b = glm::dot(to - at_, aside_);
        if ((a >= 0.0) == (b >= 0.0)) return;
        const double x = glm::dot(from - at_ + a / (a - b) * (to - from), along_);
        // What is on the left of a piece is inside: a piece that goes up has it towards negative x.
        if (x < 0.0 && x > left_) left_ = x, leaves_left_ = a >= 0.0;
        if (x >= 0.0 && x < right_) right_ = x, leaves_right_ = a < 0.0;
    }
    // In mm; none where the point is outside.
    [[nodiscard]] std::optional<RowWalls> walls() const {
        return leaves_left_ && leaves_right_ ? std::optional(RowWalls{left_, right_}) : std::nullopt;
    }

private:
    glm::dvec3 at_, along_, aside_;
    double left_, right_;
    bool leaves_left_ = false, leaves_right_ = false;
};

// `add(row, crossings)` adds the pieces in the plane of a row. `within`: only walls within the picture count.
template <class Add> Walls walls_by(const Reformation& picture, bool within, const Add& add) {
    Walls walls(picture.rows.size());
    tbb::parallel_for(std::size_t{0}, walls.size(), [&](std::size_t n) {
        const ReformationRow& row = picture.rows[n];
        const double mm = picture.mm_per_pixel;
        Crossings crossings(row, within ? (-1.0 - row.axis_column) * mm : -kInfinity,
                            within ? (picture.columns - row.axis_column) * mm : kInfinity);
        add(n, crossings);
        if (const auto found = crossings.walls())
            walls[n] = {row.axis_column + found->left / mm, row.axis_column + found->right / mm};
    });
    return walls;
}

RowLine line_of(const Reformation& picture, const ReformationRow& row) {
    return {row.plane(), row.place(-1.0), row.place(picture.columns)};
}

// Calls `call(run)` for the runs whose box meets a line.
template <class Call>
void for_runs_on_line(const BoxTree& boxes, std::size_t level, std::size_t node, const RowLine& line,
                      const Call& call) {
    for (std::size_t n = 0; n < EightBoxes::kCount; ++n) {
        const BoxTree::Box box = boxes.levels()[level][node].box(n);
        if (box.is_empty() || !mesh::line_meets_box(line.from, line.to, {glm::dvec3(box.least), glm::dvec3(box.most)}))
            continue;
        const std::size_t place = EightBoxes::kCount * node + n;
        if (level == 0)
            call(place);
        else
            for_runs_on_line(boxes, level - 1, place, line, call);
    }
}

} // namespace

Walls walls_of(const Reformation& picture, const std::vector<std::optional<Lumen>>& lumens) {
    return walls_by(picture, false, [&](std::size_t n, Crossings& crossings) {
        if (!lumens[n]) return;
        for (const Loop& loop : lumens[n]->loops)
            for (std::size_t k = 0, before = loop.points.size() - 1; k < loop.points.size(); before = k++)
                crossings.add(loop.points[before].at, loop.points[k].at);
    });
}

Walls walls_of(const Reformation& picture, const PiecesOnLine& pieces) {
    return walls_by(picture, true, [&](std::size_t n, Crossings& crossings) {
        std::vector<CutTriangle> cut;
        pieces(line_of(picture, picture.rows[n]), cut);
        for (const CutTriangle& piece : cut) crossings.add(piece.from.at, piece.to.at);
    });
}

MeshLines::MeshLines(const mesh::TriangleMesh& mesh)
    : mesh_(&mesh), boxes_(BoxTree::level_of((mesh.triangles.size() + kRun - 1) / kRun, [&](std::size_t run) {
          BoxTree::Box box;
          for (std::size_t t = kRun * run; t < std::min(kRun * (run + 1), mesh.triangles.size()); ++t)
              for (int k = 0; k < 3; ++k) box.hold(mesh.positions[mesh.triangles[t][k]]);
          return box;
      })) {}

void MeshLines::add_pieces(const RowLine& line, std::vector<CutTriangle>& pieces) const {
    if (mesh_->triangles.empty()) return;
    const std::span<const glm::uvec3> all(mesh_->triangles);
    for_runs_on_line(boxes_, boxes_.levels().size() - 1, 0, line, [&](std::size_t run) {
        cut_triangles(
            all.subspan(kRun * run, std::min(kRun, all.size() - kRun * run)), line.plane,
            [&](std::uint32_t v) { return glm::dvec3(mesh_->positions[v]); }, pieces);
    });
}

std::vector<Outline> wall_lines(const Walls& walls, double most_jump) {
    std::vector<Outline> lines;
    for (double RowWalls::*side : {&RowWalls::left, &RowWalls::right}) {
        bool continues = false;
        for (std::size_t row = 0; row < walls.size(); ++row) {
            if (!walls[row]) {
                continues = false;
                continue;
            }
            const double column = (*walls[row]).*side;
            if (!continues || std::abs(column - lines.back().back().x) > most_jump) lines.emplace_back();
            lines.back().emplace_back(column, row);
            continues = true;
        }
    }
    return lines;
}

} // namespace ramus::slice
