// Whose a place between two vertices of a surface is, so that where branches end does not depend on how triangles are
// divided.
#pragma once

#include "core/field/dominance.h"

#include <cstdint>

namespace ramus::render {

struct EdgeOwner {
    std::int32_t branch = 0;
    field::Dominance dominance{};
};
// Whose the middle of an edge is, and how clearly: between its ends logarithms of shares are linear, so that borders
// run where they did.
[[nodiscard]] EdgeOwner owner_between(const EdgeOwner& a, const EdgeOwner& b);

} // namespace ramus::render
