// Layer: how a branch is drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::render {

// The layer that a branch is drawn into, if any.
enum class Layer : std::uint8_t { kOpaque, kGlass, kNone };

// The layer of a branch; branches without an entry are opaque.
[[nodiscard]] inline Layer layer_of(const std::vector<Layer>& layers, std::size_t branch) {
    return branch < layers.size() ? layers[branch] : Layer::kOpaque;
}

} // namespace ramus::render
