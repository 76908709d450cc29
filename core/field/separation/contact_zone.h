// ContactZone: a conservative set of the cells in and around a brick in which vessels may be kept apart. It is built
// from boxes, before any point is evaluated. Outside of the zone the field is the plain sum and no wall passes.
//
// The zone is a bit mask over the cells of the brick and kMargin cells around it. Any point beyond counts as inside.
#pragma once

#include "core/base/bounds.h"
#include "core/field/brick_field.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

class ContactZone {
public:
    // A box of cells, first to last, both included; empty where `most` is below `least` along some axis.
    using Cells = Bounds<glm::ivec3>;

    // Begins a brick, with an empty zone. `axes` in mm.
    void begin(const GridAxes& axes);
    // The cells that contain a point of the box (mm), clamped to the mask.
    [[nodiscard]] Cells cells_of(const Bounds<glm::dvec3>& box) const;
    void add(const Cells& cells);
    [[nodiscard]] bool has_all(const Cells& cells) const;
    // The box of the whole mask, mm.
    [[nodiscard]] Bounds<glm::dvec3> box() const { return {origin_, origin_ + kSide / cells_per_mm_}; }
    [[nodiscard]] bool empty() const { return empty_; }
    // Whether the zone may contain a point (mm).
    [[nodiscard]] bool has(const glm::dvec3& point) const;

private:
    static constexpr int kMargin = 3; // cells around the brick
    static constexpr int kSide = kGridSide - 1 + 2 * kMargin;
    // The cells of one layer along z. Bit x + kSide y is one cell.
    struct Layer {
        std::array<std::uint64_t, 2> bits{};
    };
    static_assert(kSide * kSide <= 128);
    using Ranges = std::array<std::array<Layer, kSide>, kSide>; // [first][last]
    static Ranges make_ranges(int step);
    static const Ranges kColumns, kRows;
    // The bits that `cells` has in each of its layers.
    [[nodiscard]] static Layer layer_of(const Cells& cells);

    glm::dvec3 origin_{0.0};
    double cells_per_mm_ = 1.0;
    bool empty_ = true;
    std::array<Layer, static_cast<std::size_t>(kSide)> layers_{}; // along z
};

} // namespace ramus::field
