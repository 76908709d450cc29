// ContactZone: where vessels may be kept apart in and around a brick, as boxes tell it before any point is looked at.
// Elsewhere the plain sum holds and no wall runs.
#pragma once

#include "core/base/bounds.h"
#include "core/field/brick_field.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::field {

class ContactZone {
public:
    // Whole cells, from the first to the last; none where one of these is before the other.
    using Cells = Bounds<glm::ivec3>;
    [[nodiscard]] static bool is_empty(const Cells& cells) {
        return glm::any(glm::greaterThan(cells.least, cells.most));
    }

    // Begins a brick, with nothing in the zone.
    void begin(const GridAxes& axes);
    // The cells of a box: those with a point of it.
    [[nodiscard]] Cells cells_of(const Bounds<glm::dvec3>& box) const;
    void add(const Cells& cells);
    // Whether all of these are in the zone.
    [[nodiscard]] bool has_all(const Cells& cells) const;
    // Of all cells that it knows.
    [[nodiscard]] Bounds<glm::dvec3> box() const { return {origin_, origin_ + kSide / cells_per_mm_}; }
    [[nodiscard]] bool empty() const { return empty_; }
    // Whether the zone has a point, or may have: it is known in whole cells, and not far beyond the brick.
    [[nodiscard]] bool has(const glm::dvec3& point) const;

private:
    static constexpr int kMargin = 3; // cells around the brick
    static constexpr int kSide = kGridSide - 1 + 2 * kMargin;
    // The cells of one layer, a bit each: x + kSide y.
    struct Layer {
        std::array<std::uint64_t, 2> bits{};
    };
    static_assert(kSide * kSide <= 128);
    using Ranges = std::array<std::array<Layer, kSide>, kSide>; // by the first and the last
    static Ranges make_ranges(int step);
    static const Ranges kColumns, kRows;
    // Those of one of its layers.
    [[nodiscard]] static Layer layer_of(const Cells& cells);

    glm::dvec3 origin_{0.0};
    double cells_per_mm_ = 1.0;
    bool empty_ = true;
    std::array<Layer, static_cast<std::size_t>(kSide)> layers_{}; // along z
};

} // namespace ramus::field
