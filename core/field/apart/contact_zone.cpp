#include "core/field/apart/contact_zone.h"

#include <cstddef>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::field {

void ContactZone::begin(const GridAxes& axes) {
    const double cell = axes.x[1] - axes.x[0];
    origin_ = axes.corner() - kMargin * cell;
    cells_per_mm_ = 1.0 / cell;
    empty_ = true;
    rows_.fill(0);
}

void ContactZone::add(const Bounds<glm::dvec3>& box) {
    if (glm::any(glm::greaterThan(box.least, box.most))) return;
    // Rounded as in has(), so that a box has the cell of every point in it.
    const glm::dvec3 low = glm::floor((box.least - origin_) * cells_per_mm_);
    const glm::dvec3 high = glm::floor((box.most - origin_) * cells_per_mm_);
    if (glm::any(glm::greaterThanEqual(low, glm::dvec3(kSide))) || glm::any(glm::lessThan(high, glm::dvec3(0.0))))
        return;
    const glm::ivec3 first(glm::max(low, 0.0)), last(glm::min(high, glm::dvec3(kSide - 1)));
    const auto row = static_cast<std::uint16_t>((2U << last.x) - (1U << first.x));
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y) rows_[static_cast<std::size_t>(y + kSide * z)] |= row;
    empty_ = false;
}

bool ContactZone::has(const glm::dvec3& point) const {
    const glm::dvec3 cell = glm::floor((point - origin_) * cells_per_mm_);
    if (glm::any(glm::lessThan(cell, glm::dvec3(0.0))) || glm::any(glm::greaterThanEqual(cell, glm::dvec3(kSide))))
        return true;
    const glm::ivec3 at(cell);
    return (rows_[static_cast<std::size_t>(at.y + kSide * at.z)] >> at.x & 1U) != 0;
}

} // namespace ramus::field
