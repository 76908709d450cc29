// Letters for the pictures' own overlays, as coverage bitmaps without GL or user interface: from a TrueType font where
// there is one, else from strokes that are built in. Deterministic for a given font.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
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

class Font {
public:
    // Of a TrueType file; without a name, or where it cannot be read, the strokes that are built in (digits, the unit
    // letters and A P L R S I).
    explicit Font(const std::string& path);
    Font(); // that was configured when ramus was built

    // Latin-1 letters of one line; `capital_height` in pixels.
    [[nodiscard]] Coverage draw(std::string_view latin1, double capital_height) const;

private:
    std::vector<unsigned char> file_;
};

} // namespace ramus::render
