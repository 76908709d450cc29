#include "core/mesh/polygonize/sizing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::mesh::bricks {

namespace {

constexpr float kSlope = 0.14F;     // below 1 / (4 sqrt 3), see the proof
constexpr double kReachRadii = 1.4; // how far a vessel's own surface and its blends extend, in radii (width 5)
constexpr double kPieceRatio = 1.2; // radii within a piece differ by no more
// Cell sizes are powers of two apart: the nearest to what is asked for is taken, so up to this much more. Cells around
// the thinnest vessel are exactly as asked.
constexpr double kRounding = 1.4142135623730951;
constexpr float kSqrt3Half = 0.8660254F;

} // namespace

Sizing make_sizing(const field::ConvolutionField& field, glm::dvec3 origin, int detail, double cell_mm) {
    const field::SegmentArrays& s = field.segments();
    const double reach_radii = kReachRadii * field.kernel().support_radii / 1.7;
    const double cells_per_radius = 2.0 * std::numbers::pi / detail;
    Sizing sizing;
    sizing.finest_cell_mm = cell_mm > 0.0 ? cell_mm : std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double r0 = s.radius[i];
        const double r1 = s.end_radius(i);
        const double length = s.length[i];
        const glm::dvec3 direction(s.ux[i], s.uy[i], s.uz[i]);
        const glm::dvec3 start = glm::dvec3(s.ax[i], s.ay[i], s.az[i]) - origin;
        const double ratio = std::max(r0, r1) / std::min(r0, r1);
        const int count =
            cell_mm > 0.0 ? 1 : std::max(1, static_cast<int>(std::ceil(std::log(ratio) / std::log(kPieceRatio))));
        for (int n = 0; n < count; ++n) {
            const double t0 = length * n / count;
            const double t1 = length * (n + 1) / count;
            const double ra = r0 + s.slope[i] * t0;
            const double rb = r0 + s.slope[i] * t1;
            const double cell = cell_mm > 0.0 ? cell_mm : cells_per_radius * std::min(ra, rb);
            // About 1.5 crossed cells for every cell-sized patch of surface, two triangles each.
            sizing.expected_triangles += 3.0 * std::numbers::pi * (ra + rb) * (t1 - t0) / (cell * cell);
            if (cell_mm > 0.0) continue;
            sizing.finest_cell_mm = std::min(sizing.finest_cell_mm, cell);
            sizing.pieces.push_back({glm::vec3(start + direction * t0), glm::vec3(direction),
                                     static_cast<float>(t1 - t0), static_cast<float>(kRounding * cell),
                                     static_cast<float>(reach_radii * std::max(ra, rb))});
        }
    }
    return sizing;
}

void active_pieces(const Sizing& sizing, const std::vector<std::uint32_t>& pieces, glm::vec3 centre, float side_mm,
                   std::vector<std::uint32_t>& active) {
    active.resize(pieces.size());
    std::size_t count = 0;
    // The factor keeps a brick whose cells are as wanted, to within rounding, whole.
    const float cell = 0.25F * side_mm * 0.9999F;
    const float ball = kSqrt3Half * side_mm;
    for (const std::uint32_t index : pieces) {
        const SizingPiece& piece = sizing.pieces[index];
        const glm::vec3 offset = centre - piece.start;
        const float t = std::clamp(glm::dot(offset, piece.direction), 0.0F, piece.length);
        const glm::vec3 gap = offset - t * piece.direction;
        const float near = piece.reach_mm + ball + std::max(0.0F, (cell - piece.cell_mm) / kSlope);
        active[count] = index;
        count += piece.cell_mm < cell && glm::dot(gap, gap) < near * near ? 1 : 0;
    }
    active.resize(count);
}

} // namespace ramus::mesh::bricks
