// Wall pairs: places on the two sides of a wall between vessels that are kept apart. Each is put on its own side by the
// field; here the two are moved apart as far as a wall is wide, and kept where their triangles may be.
#pragma once

#include "core/field/brick_field.h"
#include "core/mesh/polygonize/octree/lattice.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace ramus::mesh::bricks {

// A box, which may be flat along some axes.
struct Span {
    glm::vec3 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
    void include(const glm::vec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
    [[nodiscard]] glm::vec3 size() const { return upper - lower; }
};

// Loops of a cell, or arcs of a face, with a wall between them.
struct WallPair {
    std::size_t first = 0, second = 0;
    glm::vec3 toward{0.0F}; // from the first to the second, as the cell's edges tell it
};

// `toward`: from the first one's vessel to the second one's, as the edges of their cell tell it; not 0. Both stay in
// `room`.
void part(field::OwnedPoint& first, field::OwnedPoint& second, const glm::vec3& toward, const Span& room);

// How vessels have an edge of a cell: at its lower end, at its upper end, or each at one, with a wall between.
enum class EdgeKind : std::uint8_t { kLowerInside, kUpperInside, kWall };
// Where the surface goes through an edge beside a wall: of the vessel at its lower end, and of that at its upper end;
// of one that the surface crosses once, both are the same.
struct EdgeEnds {
    field::OwnedPoint lower, upper;
};
// The same of an edge of a subtree, with the owners of its two ends, as far as they are inside.
struct KnownEnds {
    std::uint32_t edge = 0; // as edge_number() says
    std::array<field::Owner, 2> owner{field::kNoOwner, field::kNoOwner};
    EdgeEnds ends;
};
// By the number of the brick in its subtree, and the edge's middle in quarter cells from the brick's corner.
constexpr std::uint32_t edge_number(std::uint32_t brick, const glm::ivec3& middle) {
    constexpr int kSide = 4 * kBrickCells + 1;
    return static_cast<std::uint32_t>(middle.x +
                                      kSide * (middle.y + kSide * (middle.z + kSide * static_cast<int>(brick))));
}
// An edge, and the owners of its ends, as far as they are inside. Positions relative to the brick that the field is in,
// mm.
struct OwnedEdge {
    Span span;
    EdgeKind kind = EdgeKind::kLowerInside;
    field::Owner lower = field::kNoOwner, upper = field::kNoOwner;
    float guess = 0.5F; // the share of the way from the lower end at which the surface may cross it
};
[[nodiscard]] EdgeEnds ends_on_edge(field::BrickField& field, const OwnedEdge& edge);

} // namespace ramus::mesh::bricks
