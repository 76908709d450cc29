#include "render/overlay/plate.h"

#include <algorithm>
#include <cmath>

namespace ramus::render {

Plate::Plate(int width, int height, double radius, double opacity) : image_(width, height) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double dx = std::max({radius - (x + 0.5), x + 0.5 - (width - radius), 0.0});
            const double dy = std::max({radius - (y + 0.5), y + 0.5 - (height - radius), 0.0});
            const double share = std::clamp(radius - std::hypot(dx, dy) + 0.5, 0.0, 1.0);
            std::uint8_t* out = image_.pixel(x, y);
            out[0] = 13, out[1] = 15, out[2] = 18;
            out[3] = static_cast<std::uint8_t>(std::lround(255.0 * opacity * share));
        }
}

void Plate::lay(int x, int y, const glm::vec3& srgb, double share) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || share <= 0.0) return;
    std::uint8_t* out = image_.pixel(x, y);
    const double below = out[3] / 255.0 * (1.0 - share), alpha = share + below;
    for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(std::lround((255.0 * srgb[k] * share + out[k] * below) / alpha));
    out[3] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
}

void Plate::fill(double left, double top, double width, double height, const glm::vec3& srgb) {
    const auto covered = [](int pixel, double from, double to) {
        return std::clamp(std::min(pixel + 1.0, to) - std::max(double(pixel), from), 0.0, 1.0);
    };
    for (int y = int(std::floor(top)); y < std::ceil(top + height); ++y)
        for (int x = int(std::floor(left)); x < std::ceil(left + width); ++x)
            lay(x, y, srgb, covered(x, left, left + width) * covered(y, top, top + height));
}

void Plate::write(const Coverage& text, int left, int top, const glm::vec3& srgb) {
    for (int y = 0; y < text.height; ++y)
        for (int x = 0; x < text.width; ++x) lay(left + x, top + y, srgb, text.at(x, y) / 255.0);
}

Image paint_label(const std::string& text, double pixel_ratio, const Font& font) {
    const Coverage letters = font.draw(text, 8.5 * pixel_ratio);
    const int side = static_cast<int>(std::lround(5.0 * pixel_ratio)),
              edge = static_cast<int>(std::lround(1.0 * pixel_ratio));
    Plate plate(letters.width + 2 * side, letters.height + 2 * edge, 3.0 * pixel_ratio, 0.72);
    plate.write(letters, side, edge, kPlateInk);
    return std::move(plate).take();
}

} // namespace ramus::render
