#include "render/image/text.h"

#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wcast-qual"
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC // another library may contain its own copy
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace ramus::render {

extern const unsigned char kFontFile[]; // cmake/EmbedFont.cmake

Coverage draw_text(std::string_view latin1, double capital_height) {
    stbtt_fontinfo info;
    stbtt_InitFont(&info, kFontFile, 0);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBox(&info, 'H', &x0, &y0, &x1, &y1);
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
