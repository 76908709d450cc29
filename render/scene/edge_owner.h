// Finds which branch a point between two vertices belongs to, so that borders between branches do not depend on how
// triangles are divided.
#pragma once

#include "core/field/dominance.h"

#include <cstdint>

namespace ramus::render {

struct EdgeOwner {
    std::int32_t branch = 0;
    field::Dominance dominance{};
};
// Branch and dominance at the middle of an edge. Logarithms of shares are linear along the edge, so that borders stay
// in place.
[[nodiscard]] EdgeOwner owner_between(const EdgeOwner& a, const EdgeOwner& b);

} // namespace ramus::render
