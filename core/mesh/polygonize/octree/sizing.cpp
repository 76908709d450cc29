#include "core/mesh/polygonize/octree/sizing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::mesh::bricks {

namespace {

constexpr double kReachRadii = 1.4; // how far a vessel's own surface and its blends extend, in radii (width 5)
constexpr double kPieceRatio = 1.2; // radii within a piece differ by no more
constexpr double kRunBend = 0.25;   // how far a piece's segments may lie from its chord, in radii
// Cell sizes are powers of two apart: the nearest to what is asked for is taken, so up to this much more. Cells around
// the thinnest vessel are exactly as asked.
constexpr double kRounding = 1.4142135623730951;

// A run of consecutive segments that one piece can stand for: nearly straight, nearly one radius.
struct Run {
    std::size_t first, last; // segments, inclusive
    double thinnest, thickest;
    double off = 0.0; // farthest that a point of the run lies from its chord, mm
};

using Segments = std::vector<field::FieldSegment>;

glm::dvec3 start_of(const field::FieldSegment& s) { return {s.ax, s.ay, s.az}; }

glm::dvec3 end_of(const field::FieldSegment& s) {
    return start_of(s) + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz);
}

double distance_to_chord(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 chord = b - a;
    const double squared = glm::dot(chord, chord);
    const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, chord) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * chord);
}

// Voxel-spaced centerlines have segments far shorter than the vessel is wide; judging each would cost more than
// meshing.
bool extend(Run& run, const Segments& s, std::size_t next) {
    const double r0 = s[next].radius;
    const double r1 = s[next].end_radius();
    const double thinnest = std::min({run.thinnest, r0, r1});
    const double thickest = std::max({run.thickest, r0, r1});
    if (thickest > kPieceRatio * thinnest) return false;
    const glm::dvec3 a = start_of(s[run.first]);
    const glm::dvec3 b = end_of(s[next]);
    constexpr std::size_t kLongest = 16; // bounds the work of this check
    if (next - run.first >= kLongest) return false;
    double off = 0.0;
    for (std::size_t i = run.first; i <= next; ++i) {
        if (i > run.first && glm::distance(start_of(s[i]), end_of(s[i - 1])) > 1e-3 * thinnest) return false;
        off = std::max(off, distance_to_chord(start_of(s[i]), a, b));
    }
    if (off > kRunBend * thinnest) return false;
    run.last = next, run.thinnest = thinnest, run.thickest = thickest, run.off = off;
    return true;
}

} // namespace

Sizing make_sizing(const field::ConvolutionField& field, glm::dvec3 origin, int detail, double cell_mm) {
    const Segments& s = field.segments();
    const double reach_radii = kReachRadii * field.kernel().support_radii / 1.7;
    const double cells_per_radius = 2.0 * std::numbers::pi / detail;
    Sizing sizing;
    sizing.finest_cell_mm = cell_mm > 0.0 ? cell_mm : std::numeric_limits<double>::max();
    const auto add = [&](glm::dvec3 a, glm::dvec3 b, double thinnest, double thickest, double off) {
        const double length = glm::distance(a, b);
        const double cell = cell_mm > 0.0 ? cell_mm : cells_per_radius * thinnest;
        // About 1.5 crossed cells for every cell-sized patch of surface, two triangles each.
        sizing.expected_triangles += 3.0 * std::numbers::pi * (thinnest + thickest) * length / (cell * cell);
        if (cell_mm > 0.0) return;
        sizing.finest_cell_mm = std::min(sizing.finest_cell_mm, cell);
        sizing.pieces.push_back({glm::vec3(a - origin), glm::vec3(length > 0.0 ? (b - a) / length : glm::dvec3(0.0)),
                                 static_cast<float>(length), static_cast<float>(kRounding * cell),
                                 static_cast<float>(reach_radii * thickest + off)});
    };
    for (std::size_t i = 0; i < s.size();) {
        const double r0 = s[i].radius;
        const double r1 = s[i].end_radius();
        const double ratio = std::max(r0, r1) / std::min(r0, r1);
        if (ratio > kPieceRatio && cell_mm <= 0.0) {
            // A strongly conical segment is cut, so that its thick end is not meshed for its thin one.
            const int count = static_cast<int>(std::ceil(std::log(ratio) / std::log(kPieceRatio)));
            const glm::dvec3 a = start_of(s[i]);
            const glm::dvec3 b = end_of(s[i]);
            for (int n = 0; n < count; ++n) {
                const double f0 = static_cast<double>(n) / count;
                const double f1 = static_cast<double>(n + 1) / count;
                const double ra = r0 + (r1 - r0) * f0;
                const double rb = r0 + (r1 - r0) * f1;
                add(a + (b - a) * f0, a + (b - a) * f1, std::min(ra, rb), std::max(ra, rb), 0.0);
            }
            ++i;
            continue;
        }
        Run run{i, i, std::min(r0, r1), std::max(r0, r1)};
        while (run.last + 1 < s.size() && extend(run, s, run.last + 1)) {
        }
        add(start_of(s[run.first]), end_of(s[run.last]), run.thinnest, run.thickest, run.off);
        i = run.last + 1;
    }
    return sizing;
}

int finest_level(const Sizing& sizing, std::span<const std::uint32_t> pieces, const Lattice& lattice) {
    if (pieces.empty()) return 0;
    float cell = std::numeric_limits<float>::max();
    for (const std::uint32_t p : pieces) cell = std::min(cell, sizing.pieces[p].cell_mm);
    return std::max(0, std::ilogb(static_cast<double>(cell) * 1.0001 / lattice.cell_mm(0)));
}

} // namespace ramus::mesh::bricks
