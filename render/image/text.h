// Draws text for overlays as coverage bitmaps, without GL or user interface. Uses the TrueType font that was configured
// at build time and is embedded in the program. Deterministic.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace ramus::render {

struct Coverage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> values; // rows from the top

    Coverage() = default;
    Coverage(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    [[nodiscard]] std::uint8_t at(int x, int y) const {
        return x < 0 || y < 0 || x >= width || y >= height
                   ? std::uint8_t{0}
                   : values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)];
    }
    // Keeps the larger of the old and the new value.
    void put(int x, int y, std::uint8_t value) {
        auto& old = values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        old = std::max(old, value);
    }
    void put(int left, int top, const Coverage& other) {
        for (int y = 0; y < other.height; ++y)
            for (int x = 0; x < other.width; ++x) put(left + x, top + y, other.at(x, y));
    }
};

// One line of Latin-1; `capital_height` in pixels.
[[nodiscard]] Coverage draw_text(std::string_view latin1, double capital_height);

} // namespace ramus::render
