#include "app/window/cursor_image.h"

#include "core/base/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace ramus::app {

namespace {

constexpr int kSide = 32; // points
constexpr glm::vec2 kTip{3.5F, 28.5F};

// The rope from its tip to the loop: a quadratic curve, in segments.
std::vector<glm::vec2> rope() {
    constexpr glm::vec2 kBend{4.5F, 18.0F}, kKnot{10.5F, 15.5F};
    std::vector<glm::vec2> points;
    for (int i = 0; i <= 8; ++i) {
        const float t = static_cast<float>(i) / 8.0F, s = 1.0F - t;
        points.push_back(s * s * kTip + 2.0F * s * t * kBend + t * t * kKnot);
    }
    return points;
}

std::vector<glm::vec2> loop(Cursor cursor) {
    if (cursor == Cursor::kLassoPolygon)
        return {{10.5F, 15.5F}, {7.5F, 7.0F}, {17.0F, 2.5F}, {28.5F, 6.0F}, {25.0F, 15.0F}, {10.5F, 15.5F}};
    std::vector<glm::vec2> points;
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / kSteps;
        points.emplace_back(18.0F + 10.5F * std::cos(angle), 9.5F + 6.8F * std::sin(angle));
    }
    return points;
}

} // namespace

std::optional<CursorImage> cursor_image(Cursor cursor, float scale) {
    if (cursor != Cursor::kLasso && cursor != Cursor::kLassoPolygon) return {};
    const int side = static_cast<int>(std::lround(static_cast<float>(kSide) * scale));
    CursorImage made{render::Image(side, side), glm::ivec2(glm::round(scale * kTip))};
    const std::array lines{rope(), loop(cursor)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5F) / scale;
            float nearest = 1e9F;
            for (const auto& line : lines)
                for (std::size_t i = 0; i + 1 < line.size(); ++i)
                    nearest = std::min(nearest, distance_to_line(p, line[i], line[i + 1]));
            nearest = std::min(nearest, glm::distance(p, kTip) - 1.2F);
            // A light line with a dark edge is visible on any background.
            const float light = glm::clamp((0.9F - nearest) * scale + 0.5F, 0.0F, 1.0F);
            const float dark = glm::clamp((2.0F - nearest) * scale + 0.5F, 0.0F, 1.0F);
            if (dark <= 0.0F) continue;
            const auto tone = static_cast<std::uint8_t>(std::lround(255.0F * glm::mix(0.08F, 1.0F, light / dark)));
            std::uint8_t* pixel = made.image.pixel(x, y);
            pixel[0] = pixel[1] = pixel[2] = tone;
            pixel[3] = static_cast<std::uint8_t>(std::lround(255.0F * dark));
        }
    return made;
}

} // namespace ramus::app
