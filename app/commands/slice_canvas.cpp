#include "app/commands/slice_canvas.h"

#include "app/picture/colouring.h"
#include "render/image/canvas.h"
#include "render/image/text.h"
#include "render/overlay/captions.h"

#include <algorithm>
#include <cmath>

namespace ramus::app {

namespace {

constexpr std::uint8_t kOutsideOfScan = 32;

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

void SliceCanvas::put_line(std::span<const glm::dvec2> points, const glm::vec3& srgb, double width, glm::ivec2 low,
                           glm::ivec2 high) {
    render::Canvas(image_, low, high).line(points, false, {srgb, static_cast<float>(width), 1.0F});
}

void SliceCanvas::put_text(const std::string& text, glm::ivec2 at, double capital_height) {
    const render::Coverage ink = render::draw_text(latin1(text), capital_height);
    constexpr int kHalo = 2;
    render::Coverage padded(ink.width + 2 * kHalo, ink.height + 2 * kHalo);
    padded.put(kHalo, kHalo, ink);
    render::Canvas(image_).picture(render::haloed(padded, kHalo), at);
}

} // namespace ramus::app
