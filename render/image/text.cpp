#include "render/image/text.h"

#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>
#include <iterator>
#include <map>
#include <utility>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wcast-qual"
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC // another library in the program may carry a copy of its own
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace ramus::render {

namespace {

// The built-in letters: polylines on a grid 4 wide and 6 high, y upward from the baseline; "12 34 | 56" lifts the pen
// at |.
const std::map<char, std::pair<double, const char*>> kStrokes{
    {'0', {4, "10 01 05 16 36 45 41 30 10"}},
    {'1', {3, "05 26 20 | 00 30"}},
    {'2', {4, "05 16 36 45 44 00 40"}},
    {'3', {4, "05 16 36 45 44 33 13 | 33 42 41 30 10 01"}},
    {'4', {4, "30 36 02 42"}},
    {'5', {4, "46 06 03 33 42 41 30 10 01"}},
    {'6', {4, "45 36 16 05 01 10 30 41 42 33 13 02"}},
    {'7', {4, "06 46 10"}},
    {'8', {4, "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33"}},
    {'9', {4, "01 10 30 41 45 36 16 05 04 13 33 44"}},
    {'.', {1, "00 01"}},
    {'m', {4, "00 04 | 03 14 23 20 | 23 34 43 40"}},
    {'c', {3, "33 24 14 03 01 10 20 31"}},
    {'k', {3, "00 06 | 34 02 | 13 30"}},
    {'n', {3, "00 04 | 03 14 24 33 30"}},
    {'\xb5', {3, "04 01 10 20 31 | 34 30 | 01 0/"}}, // '/' is one below '0'
    {'A', {4, "00 26 40 | 12 32"}},
    {'P', {4, "00 06 36 45 44 33 03"}},
    {'L', {4, "06 00 40"}},
    {'R', {4, "00 06 36 45 44 33 03 | 23 40"}},
    {'S', {4, "45 36 16 05 04 13 33 42 41 30 10 01"}},
    {'I', {2, "06 26 | 16 10 | 00 20"}},
};

Coverage draw_strokes(std::string_view text, double capital_height) {
    const double unit = capital_height / 6.0, pen = std::max(0.55, 0.075 * capital_height), gap = 1.7 * unit + pen;
    const double margin = pen + 1.0;
    double width = 0.0;
    for (const char c : text) width += (kStrokes.contains(c) ? kStrokes.at(c).first * unit : 2.0 * unit) + gap;
    Coverage result(static_cast<int>(std::ceil(width - gap + 2.0 * margin)),
                    static_cast<int>(std::ceil(capital_height + unit + 2.0 * margin)));
    double left = margin;
    for (const char c : text) {
        if (!kStrokes.contains(c)) {
            left += 2.0 * unit + gap;
            continue;
        }
        const auto& [advance, path] = kStrokes.at(c);
        const std::string_view points(path);
        bool down = false;
        glm::dvec2 a(0.0);
        for (std::size_t i = 0; i < points.size();) {
            if (points[i] == '|') {
                down = false;
                i += 2;
                continue;
            }
            const glm::dvec2 b(left + (points[i] - '0') * unit, margin + capital_height - (points[i + 1] - '0') * unit);
            i += 3;
            if (down) {
                for (int y = 0; y < result.height; ++y)
                    for (int x = 0; x < result.width; ++x) {
                        const double d = distance_to_line(glm::dvec2(x + 0.5, y + 0.5), a, b);
                        result.put(x, y, static_cast<std::uint8_t>(255.0 * std::clamp(pen + 0.5 - d, 0.0, 1.0)));
                    }
            }
            down = true;
            a = b;
        }
        left += advance * unit + gap;
    }
    return result;
}

} // namespace

Font::Font(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!path.empty()) file_.assign(std::istreambuf_iterator<char>(file), {});
}

Font::Font() : Font(RAMUS_FONT) {}

Coverage Font::draw(std::string_view latin1, double capital_height) const {
    stbtt_fontinfo info;
    if (file_.size() < 1024 || stbtt_InitFont(&info, file_.data(), 0) == 0) return draw_strokes(latin1, capital_height);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBox(&info, 'H', &x0, &y0, &x1, &y1);
    if (y1 <= 0) return draw_strokes(latin1, capital_height);
    const auto scale = static_cast<float>(capital_height / y1);

    const int margin = 1, ascent = static_cast<int>(std::ceil(1.15 * capital_height)) + margin;
    const int descent = static_cast<int>(std::ceil(0.35 * capital_height)) + margin;
    float width = 0.0F;
    for (const char c : latin1) {
        int advance = 0, bearing = 0;
        stbtt_GetCodepointHMetrics(&info, static_cast<unsigned char>(c), &advance, &bearing);
        width += scale * static_cast<float>(advance);
    }
    Coverage result(static_cast<int>(std::ceil(width)) + 2 * margin, ascent + descent);
    float pen = static_cast<float>(margin);
    for (const char c : latin1) {
        const int code = static_cast<unsigned char>(c);
        int advance = 0, bearing = 0;
        stbtt_GetCodepointHMetrics(&info, code, &advance, &bearing);
        const float shift = pen - std::floor(pen);
        int gw = 0, gh = 0, gx = 0, gy = 0;
        unsigned char* glyph =
            stbtt_GetCodepointBitmapSubpixel(&info, scale, scale, shift, 0.0F, code, &gw, &gh, &gx, &gy);
        for (int y = 0; y < gh; ++y)
            for (int x = 0; x < gw; ++x) {
                const int px = static_cast<int>(std::floor(pen)) + gx + x, py = ascent + gy + y;
                if (px < 0 || py < 0 || px >= result.width || py >= result.height) continue;
                result.put(px, py, glyph[y * gw + x]);
            }
        stbtt_FreeBitmap(glyph, nullptr);
        pen += scale * static_cast<float>(advance);
    }
    return result;
}

} // namespace ramus::render
