// Letters for the pictures' own overlays, as coverage bitmaps without GL or user interface: of the TrueType font that
// was configured when ramus was built and is part of the program. Deterministic.
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
    // Where something is already, the larger of both.
    void put(int x, int y, std::uint8_t value) {
        auto& old = values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        old = std::max(old, value);
    }
    void put(int left, int top, const Coverage& other) {
        for (int y = 0; y < other.height; ++y)
            for (int x = 0; x < other.width; ++x) put(left + x, top + y, other.at(x, y));
    }
};

// Latin-1 letters of one line; `capital_height` in pixels.
[[nodiscard]] Coverage draw_text(std::string_view latin1, double capital_height);

} // namespace ramus::render
