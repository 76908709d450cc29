#include "app/session/colour_text.h"

#include <charconv>

namespace ramus::app {

std::string colour_text(const std::array<std::uint8_t, 3>& colour) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t byte : colour) text += {kDigits[byte >> 4U], kDigits[byte & 15U]};
    return text;
}

std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text) {
    if (text.starts_with('#')) text.remove_prefix(1);
    std::array<std::uint8_t, 3> colour{};
    if (text.size() != 6) return {};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string_view two = text.substr(2 * i, 2);
        const auto [end, error] = std::from_chars(two.data(), two.data() + 2, colour[i], 16);
        if (error != std::errc() || end != two.data() + 2) return {};
    }
    return colour;
}

} // namespace ramus::app
