#include "app/commands/slice_canvas.h"

#include "app/picture/colouring.h"
#include "render/image/text.h"
#include "render/overlay/captions.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

constexpr std::uint8_t kOutsideOfScan = 32;

double distance_to_piece(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(at - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(at, a + share * along);
}

} // namespace

SliceCanvas::SliceCanvas(int width, int height) : image_(width, height) { image_.fill(glm::vec3(0.0F)); }

void SliceCanvas::put_values(std::span<const float> values, int columns, glm::ivec2 at, const slice::Window& window) {
    for (std::size_t n = 0; n < values.size(); ++n) {
        const auto x = static_cast<int>(n % static_cast<std::size_t>(columns));
        const auto y = static_cast<int>(n / static_cast<std::size_t>(columns));
        const double grey = window.grey(values[n]);
        const auto byte = std::isnan(grey) ? kOutsideOfScan : static_cast<std::uint8_t>(std::lround(255.0 * grey));
        std::fill_n(image_.pixel(at.x + x, at.y + y), 3, byte);
    }
}

void SliceCanvas::mix(int x, int y, const glm::vec3& srgb, double share) {
    for (int k = 0; k < 3; ++k) {
        std::uint8_t& byte = image_.pixel(x, y)[k];
        byte = static_cast<std::uint8_t>(std::lround((1.0 - share) * byte + share * 255.0 * double{srgb[k]}));
    }
}

void SliceCanvas::put_line(std::span<const glm::dvec2> points, const glm::vec3& srgb, double width, glm::ivec2 low,
                           glm::ivec2 high) {
    low = glm::max(low, glm::ivec2(0)), high = glm::min(high, glm::ivec2(image_.width, image_.height));
    const glm::ivec2 size = high - low;
    if (size.x <= 0 || size.y <= 0) return;
    // Each pixel gets the greatest coverage of all pieces, so that joints are not painted twice.
    render::Coverage cover(size.x, size.y);
    const double reach = 0.5 * width + 0.5;
    for (std::size_t n = 1; n < points.size(); ++n) {
        const glm::dvec2 a = points[n - 1] - glm::dvec2(low), b = points[n] - glm::dvec2(low);
        const glm::ivec2 from(glm::clamp(glm::floor(glm::min(a, b) - reach), glm::dvec2(0.0), glm::dvec2(size)));
        const glm::ivec2 to(glm::clamp(glm::ceil(glm::max(a, b) + reach), glm::dvec2(-1.0), glm::dvec2(size - 1)));
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                const double covered = std::clamp(reach - distance_to_piece({x, y}, a, b), 0.0, 1.0);
                if (covered > 0.0) cover.put(x, y, static_cast<std::uint8_t>(std::lround(255.0 * covered)));
            }
    }
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (const std::uint8_t covered = cover.at(x, y); covered > 0)
                mix(low.x + x, low.y + y, srgb, covered / 255.0);
}

void SliceCanvas::put_text(const std::string& text, glm::ivec2 at, double capital_height) {
    const render::Coverage ink = render::draw_text(latin1(text), capital_height);
    constexpr int kHalo = 2;
    render::Coverage padded(ink.width + 2 * kHalo, ink.height + 2 * kHalo);
    padded.put(kHalo, kHalo, ink);
    const render::Image words = render::haloed(padded, kHalo);
    for (int y = 0; y < words.height; ++y)
        for (int x = 0; x < words.width; ++x) {
            const glm::ivec2 on = at + glm::ivec2(x, y);
            if (on.x < 0 || on.y < 0 || on.x >= image_.width || on.y >= image_.height) continue;
            const std::uint8_t* from = words.pixel(x, y);
            mix(on.x, on.y, glm::vec3(from[0], from[1], from[2]) / 255.0F, from[3] / 255.0);
        }
}

} // namespace ramus::app
