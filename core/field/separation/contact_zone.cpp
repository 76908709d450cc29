#include "core/field/separation/contact_zone.h"

#include <cstddef>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::field {

// For each range, the cells of a layer whose x (step 1) or y (step kSide) is in the range.
ContactZone::Ranges ContactZone::make_ranges(int step) {
    Ranges ranges{};
    for (int first = 0; first < kSide; ++first)
        for (int last = first; last < kSide; ++last)
            for (int cell = 0; cell < kSide * kSide; ++cell) {
                const int at = cell / step % kSide;
                Layer& layer = ranges[static_cast<std::size_t>(first)][static_cast<std::size_t>(last)];
                if (at >= first && at <= last)
                    layer.bits[static_cast<std::size_t>(cell / 64)] |= std::uint64_t{1} << cell % 64;
            }
    return ranges;
}

const ContactZone::Ranges ContactZone::kColumns = make_ranges(1), ContactZone::kRows = make_ranges(kSide);

void ContactZone::begin(const GridAxes& axes) {
    const double cell = axes.x[1] - axes.x[0];
    origin_ = axes.corner() - kMargin * cell;
    cells_per_mm_ = 1.0 / cell;
    empty_ = true;
    layers_.fill({});
}

// Rounds as has() does, so that a box contains the cell of each of its points.
ContactZone::Cells ContactZone::cells_of(const Bounds<glm::dvec3>& box) const {
    const auto cell_of = [&](const glm::dvec3& place) {
        return glm::ivec3(glm::clamp(glm::floor((place - origin_) * cells_per_mm_), -1.0, 1.0 * kSide));
    };
    return {glm::max(cell_of(box.least), 0), glm::min(cell_of(box.most), kSide - 1)};
}

ContactZone::Layer ContactZone::layer_of(const Cells& cells) {
    const auto range = [&](const Ranges& ranges, int axis) {
        return ranges[static_cast<std::size_t>(cells.least[axis])][static_cast<std::size_t>(cells.most[axis])].bits;
    };
    const auto columns = range(kColumns, 0), rows = range(kRows, 1);
    return {{columns[0] & rows[0], columns[1] & rows[1]}};
}

void ContactZone::add(const Cells& cells) {
    if (cells.is_empty()) return;
    const auto [low, high] = layer_of(cells).bits;
    for (int z = cells.least.z; z <= cells.most.z; ++z) {
        Layer& layer = layers_[static_cast<std::size_t>(z)];
        layer.bits[0] |= low, layer.bits[1] |= high;
    }
    empty_ = false;
}

bool ContactZone::has_all(const Cells& cells) const {
    if (cells.is_empty()) return true;
    const auto [low, high] = layer_of(cells).bits;
    for (int z = cells.least.z; z <= cells.most.z; ++z) {
        const Layer& layer = layers_[static_cast<std::size_t>(z)];
        if ((low & ~layer.bits[0]) != 0 || (high & ~layer.bits[1]) != 0) return false;
    }
    return true;
}

bool ContactZone::has(const glm::dvec3& point) const {
    const glm::dvec3 cell = glm::floor((point - origin_) * cells_per_mm_);
    if (glm::any(glm::lessThan(cell, glm::dvec3(0.0))) || glm::any(glm::greaterThanEqual(cell, glm::dvec3(kSide))))
        return true;
    const glm::ivec3 at(cell);
    const auto n = static_cast<std::size_t>(at.x + kSide * at.y);
    return (layers_[static_cast<std::size_t>(at.z)].bits[n / 64] >> n % 64 & 1U) != 0;
}

} // namespace ramus::field
