#include "core/mesh/polygonize/octree/sizing.h"

#include "core/base/morton.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace ramus::mesh::bricks {

namespace {

constexpr double kPieceRatio = 1.2;  // largest ratio of two radii within a piece
constexpr double kLeastAround = 1.0; // triangles for each cell along a vessel, as far as memory goes
constexpr double kRunBend = 0.25;    // how far a piece's segments may lie from its chord, in radii

// A run of consecutive segments that one piece can represent: nearly straight, with nearly one radius.
struct Run {
    std::size_t first, last; // segments, inclusive
    double thinnest, thickest;
    double widest;       // as FieldSegment::thickest()
    double off = 0.0;    // farthest that a point of the run lies from its chord, mm
    double extent = 0.0; // farthest that a point of the run lies from its start, mm
};

using Segments = std::vector<field::FieldSegment>;

glm::dvec3 start_of(const field::FieldSegment& s) { return {s.ax, s.ay, s.az}; }

glm::dvec3 end_of(const field::FieldSegment& s) {
    return start_of(s) + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz);
}

double squared(glm::dvec3 v) { return glm::dot(v, v); }

// A run ends with its branch, so that the pieces of a branch do not depend on other branches. Runs are necessary since
// centerlines from voxels have segments far shorter than the radius: testing each would cost more than meshing.
bool extend(Run& run, const Segments& s, std::size_t next) {
    const double r0 = s[next].radius;
    const double r1 = s[next].end_radius();
    const double thinnest = std::min({run.thinnest, r0, r1});
    const double thickest = std::max({run.thickest, r0, r1});
    constexpr std::size_t kLongest = 16; // bounds the work of this check
    if (thickest > kPieceRatio * thinnest || next - run.first >= kLongest || s[next].branch != s[run.first].branch)
        return false;
    if (glm::distance(start_of(s[next]), end_of(s[next - 1])) > 1e-3 * thinnest) return false;
    const glm::dvec3 a = start_of(s[run.first]);
    const glm::dvec3 chord = end_of(s[next]) - a;
    const double inverse = squared(chord) > 0.0 ? 1.0 / squared(chord) : 0.0;
    double off2 = 0.0;
    for (std::size_t i = next; i > run.first; --i) {
        const glm::dvec3 from_a = start_of(s[i]) - a;
        const double t = std::clamp(glm::dot(from_a, chord) * inverse, 0.0, 1.0);
        off2 = std::max(off2, squared(from_a - t * chord));
    }
    if (off2 > kRunBend * kRunBend * thinnest * thinnest) return false;
    run.last = next, run.thinnest = thinnest, run.thickest = thickest, run.off = std::sqrt(off2);
    run.widest = std::max(run.widest, double(s[next].thickest()));
    run.extent = std::max(run.extent, glm::length(chord));
    return true;
}

glm::vec3 end_of(const SizingPiece& piece) { return piece.start + piece.length * piece.direction; }

void group_pieces(Sizing& sizing, float half_extent) {
    // Sorts by position on the Morton curve, then by index.
    LargeArray<std::uint64_t> order(sizing.pieces.get_allocator());
    order.reserve(sizing.pieces.size());
    for (const SizingPiece& piece : sizing.pieces) {
        const glm::vec3 position = (0.5F * (piece.start + end_of(piece)) + half_extent) / (2.0F * half_extent);
        const std::uint64_t key = morton(glm::uvec3(glm::clamp(position * 1024.0F, 0.0F, 1023.0F)));
        order.push_back(key << 32 | order.size());
    }
    std::ranges::sort(order);
    sizing.grouped.reserve(order.size());
    for (const std::uint64_t entry : order) sizing.grouped.push_back(static_cast<std::uint32_t>(entry));
    const std::size_t count = (sizing.pieces.size() + Sizing::kGroupPieces - 1) / Sizing::kGroupPieces;
    sizing.groups.resize(count);
    for (std::uint32_t g = 0; g < count; ++g) {
        SizingPiece& group = sizing.groups[g];
        const auto members = pieces_of_group(sizing, g);
        for (const std::uint32_t p : members)
            group.start +=
                0.5F * (sizing.pieces[p].start + end_of(sizing.pieces[p])) / static_cast<float>(members.size());
        group.cell_mm = std::numeric_limits<float>::max();
        for (const std::uint32_t p : members) {
            const SizingPiece& piece = sizing.pieces[p];
            const float farthest =
                std::max(glm::distance(group.start, piece.start), glm::distance(group.start, end_of(piece)));
            group.reach_mm = std::max(group.reach_mm, piece.reach_mm + 1.001F * farthest);
            group.cell_mm = std::min(group.cell_mm, piece.cell_mm);
        }
    }
}

// Divides a strongly conical segment, so that its thick end does not get the cells of its thin end. The ratio is that
// of its larger radius to its smaller one.
template <class Add> void add_cone(const field::FieldSegment& s, double ratio, double reach_radii, const Add& add) {
    const double r0 = s.radius;
    const double r1 = s.end_radius();
    const int count = static_cast<int>(std::ceil(std::log(ratio) / std::log(kPieceRatio)));
    const glm::dvec3 a = start_of(s);
    const glm::dvec3 b = end_of(s);
    for (int part = 0; part < count; ++part) {
        const double f0 = static_cast<double>(part) / count;
        const double f1 = static_cast<double>(part + 1) / count;
        const double ra = r0 + (r1 - r0) * f0;
        const double rb = r0 + (r1 - r0) * f1;
        add(s.branch, a + (b - a) * f0, a + (b - a) * f1, std::min(ra, rb), std::max(ra, rb),
            reach_radii * std::max(ra, rb) * double(s.thickest()) / std::max(r0, r1), 0.0);
    }
}

} // namespace

Sizing make_sizing(const field::Field& field, int detail, double cell_mm, const LargeAllocator<std::byte>& memory) {
    const Segments& s = field.skeleton().segments();
    const glm::dvec3 origin = field.extent().middle();
    // The whole support, so that a cube that a segment reaches is never coarser than the segment requires.
    const double reach_radii = field.support_radii();
    const double cells_per_radius = 2.0 * std::numbers::pi / detail;
    Sizing sizing;
    sizing.pieces = LargeArray<SizingPiece>(memory);
    sizing.grouped = LargeArray<std::uint32_t>(memory);
    sizing.finest_cell_mm = cell_mm > 0.0 ? cell_mm : cells_per_radius * field.extent().thinnest;
    double ball = 0.0; // triangles
    const auto add = [&](std::int32_t branch, glm::dvec3 a, glm::dvec3 b, double thinnest, double thickest,
                         double reach, double extent) {
        const double length = glm::distance(a, b);
        const double cell = cell_mm > 0.0 ? cell_mm : cells_per_radius * thinnest;
        // About 1.5 crossed cells for every cell-sized patch of surface, with two triangles each. A run that returns to
        // its start counts with its extent, and a vessel far thinner than cells still has bricks along it.
        const double around = 3.0 * std::numbers::pi * (thinnest + thickest) / cell;
        sizing.expected_triangles += std::max(around, kLeastAround) * std::max(length, extent) / cell;
        // If all vessels are shorter than thick, the surface is about a sphere.
        ball = std::max(ball, 12.0 * std::numbers::pi * thickest * thickest / (cell * cell));
        if (cell_mm > 0.0) return;
        sizing.pieces.push_back({glm::vec3(a - origin), glm::vec3(length > 0.0 ? (b - a) / length : glm::dvec3(0.0)),
                                 static_cast<float>(length), static_cast<float>(Sizing::kRounding * cell),
                                 static_cast<float>(reach), branch});
    };
    const std::vector<std::uint32_t>& present = field.skeleton().present();
    for (std::size_t n = 0; n < present.size();) {
        const std::size_t i = present[n];
        const double r0 = s[i].radius;
        const double r1 = s[i].end_radius();
        const double ratio = std::max(r0, r1) / std::min(r0, r1);
        if (ratio > kPieceRatio && cell_mm <= 0.0) {
            add_cone(s[i], ratio, reach_radii, add);
            ++n;
            continue;
        }
        Run run{i, i, std::min(r0, r1), std::max(r0, r1), double(s[i].thickest()), 0.0, double(s[i].length)};
        std::size_t end = n + 1;
        while (end < present.size() && present[end] == run.last + 1 && extend(run, s, run.last + 1)) ++end;
        add(s[i].branch, start_of(s[run.first]), end_of(s[run.last]), run.thinnest, run.thickest,
            reach_radii * run.widest + run.off, run.extent);
        n = end;
    }
    sizing.expected_triangles = std::max(sizing.expected_triangles, ball);
    if (cell_mm <= 0.0) {
        sizing.cell_per_radius = cells_per_radius;
        const glm::vec3 size(field.extent().upper - field.extent().lower);
        group_pieces(sizing, 0.5F * std::max({size.x, size.y, size.z}));
    }
    return sizing;
}

float most_asked(const Sizing& sizing, float radius) {
    return static_cast<float>(Sizing::kRounding * sizing.cell_per_radius) * radius;
}

bool can_matter(const SizingPiece& piece, glm::vec3 middle, float side, float most) {
    const float along = std::clamp(glm::dot(middle - piece.start, piece.direction), 0.0F, piece.length);
    const float gap = glm::distance(middle, piece.start + along * piece.direction);
    constexpr float kSqrt3Half = 0.8660254F;
    const float beyond = std::max(0.0F, gap - kSqrt3Half * side - piece.reach_mm);
    return 0.999F * (piece.cell_mm + Sizing::kSlope * beyond) < most;
}

int level_of_radius(const Sizing& sizing, double radius, const Lattice& lattice) {
    if (sizing.cell_per_radius == 0.0) return 0;
    return std::max(0, std::ilogb(1.0001 * sizing.cell_per_radius * radius / lattice.cell_mm(0)));
}

} // namespace ramus::mesh::bricks
