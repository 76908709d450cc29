// ContactZone: where vessels may be kept apart in and around a brick, as boxes tell it before any point is looked at.
// Elsewhere the plain sum holds and no wall runs.
#pragma once

#include "core/base/bounds.h"
#include "core/field/brick_field.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

class ContactZone {
public:
    // Begins a brick, with nothing in the zone.
    void begin(const GridAxes& axes);
    void add(const Bounds<glm::dvec3>& box);
    [[nodiscard]] bool empty() const { return empty_; }
    // Whether the zone has a point, or may have: it is known in whole cells, and not far beyond the brick.
    [[nodiscard]] bool has(const glm::dvec3& point) const;

private:
    static constexpr int kMargin = 3; // cells around the brick
    static constexpr int kSide = kGridSide - 1 + 2 * kMargin;
    glm::dvec3 origin_{0.0};
    double cells_per_mm_ = 1.0;
    bool empty_ = true;
    std::array<std::uint16_t, static_cast<std::size_t>(kSide* kSide)> rows_{}; // along x, by y + kSide z
};

} // namespace ramus::field
