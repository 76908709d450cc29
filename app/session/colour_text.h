// Colours as people write them: #RRGGBB, in sRGB. The sign may be left out: in commands files it begins a comment.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::app {

[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#c98268"
[[nodiscard]] std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text);

} // namespace ramus::app
