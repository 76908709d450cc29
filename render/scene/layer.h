#pragma once

#include <cstdint>

namespace ramus::render {

// Which of the two layers a branch is drawn into, if any.
enum class Layer : std::uint8_t { kOpaque, kGlass, kNone };

} // namespace ramus::render
