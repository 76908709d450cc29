#include "render/image/canvas.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

// Pixels in a picture: columns and rows, the ends included.
struct PixelBox {
    int left, top, right, bottom;
    [[nodiscard]] bool empty() const { return left > right || top > bottom; }
    [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(right - left + 1); }
    [[nodiscard]] std::size_t height() const { return static_cast<std::size_t>(bottom - top + 1); }
};

PixelBox pixels_around(const glm::dvec2& least, const glm::dvec2& most, double reach, const PixelBox& within) {
    // Far away points must not overflow.
    const auto whole = [](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
    return {std::max(whole(std::floor(least.x - reach)), within.left),
            std::max(whole(std::floor(least.y - reach)), within.top),
            std::min(whole(std::ceil(most.x + reach)), within.right),
            std::min(whole(std::ceil(most.y + reach)), within.bottom)};
}

double distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(p - a - share * along);
}

} // namespace

Canvas::Canvas(Image& image, glm::ivec2 low, glm::ivec2 high)
    : image_(image), low_(glm::max(low, glm::ivec2(0))), high_(glm::min(high, glm::ivec2(image.width, image.height))) {}

void Canvas::blend(int x, int y, const glm::vec3& colour, float opacity) {
    std::uint8_t* const out = image_.pixel(x, y);
    for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(std::lround((1.0F - opacity) * out[k] + 255.0F * opacity * colour[k]));
}

void Canvas::line(std::span<const glm::dvec2> points, bool closed, const Stroke& stroke) {
    if (points.empty()) return;
    const PixelBox all{low_.x, low_.y, high_.x - 1, high_.y - 1};
    glm::dvec2 least = points.front();
    glm::dvec2 most = least;
    for (const glm::dvec2& point : points) least = glm::min(least, point), most = glm::max(most, point);
    const double reach = 0.5 * stroke.width + 0.5; // where the coverage is 0
    const PixelBox box = pixels_around(least, most, reach, all);
    if (box.empty()) return;
    coverage_.assign(box.width() * box.height(), 0.0F);
    const auto cover = [&](const glm::dvec2& a, const glm::dvec2& b) {
        const PixelBox near = pixels_around(glm::min(a, b), glm::max(a, b), reach, box);
        for (int y = near.top; y <= near.bottom; ++y)
            for (int x = near.left; x <= near.right; ++x) {
                const auto covered = static_cast<float>(std::clamp(reach - distance({x, y}, a, b), 0.0, 1.0));
                float& kept = coverage_[static_cast<std::size_t>(y - box.top) * box.width() +
                                        static_cast<std::size_t>(x - box.left)];
                kept = std::max(kept, covered);
            }
    };
    for (std::size_t n = 0; n + 1 < points.size(); ++n) cover(points[n], points[n + 1]);
    if (closed || points.size() == 1) cover(points.back(), points.front());
    for (int y = box.top; y <= box.bottom; ++y)
        for (int x = box.left; x <= box.right; ++x) {
            const float covered =
                coverage_[static_cast<std::size_t>(y - box.top) * box.width() + static_cast<std::size_t>(x - box.left)];
            if (covered > 0.0F) blend(x, y, stroke.colour, covered * stroke.opacity);
        }
}

void Canvas::area(std::span<const std::vector<glm::dvec2>> polygons, const glm::vec3& colour, float opacity) {
    if (low_.x >= high_.x || low_.y >= high_.y) return;
    // For every row, where the polygons cross the middle of its pixels.
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(high_.y - low_.y));
    for (const std::vector<glm::dvec2>& polygon : polygons)
        for (std::size_t n = 0; n < polygon.size(); ++n) {
            const glm::dvec2& a = polygon[n];
            const glm::dvec2& b = polygon[(n + 1) % polygon.size()];
            const double first = std::max<double>(low_.y, std::ceil(std::min(a.y, b.y)));
            const double end = std::min<double>(high_.y, std::ceil(std::max(a.y, b.y)));
            for (double y = first; y < end; ++y)
                crossings[static_cast<std::size_t>(y - low_.y)].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    for (int y = low_.y; y < high_.y; ++y) {
        std::vector<double>& row = crossings[static_cast<std::size_t>(y - low_.y)];
        std::ranges::sort(row);
        for (std::size_t n = 0; n + 1 < row.size(); n += 2) {
            const double first = std::max<double>(low_.x, std::ceil(row[n]));
            const double end = std::min<double>(high_.x, std::ceil(row[n + 1]));
            for (double x = first; x < end; ++x) blend(static_cast<int>(x), y, colour, opacity);
        }
    }
}

void Canvas::picture(const Image& picture, glm::ivec2 corner) {
    const glm::ivec2 first = glm::max(low_ - corner, glm::ivec2(0));
    const glm::ivec2 end = glm::min(high_ - corner, glm::ivec2(picture.width, picture.height));
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const std::uint8_t* const in = picture.pixel(x, y);
            if (in[3] == 0) continue;
            blend(corner.x + x, corner.y + y, glm::vec3(in[0], in[1], in[2]) / 255.0F,
                  static_cast<float>(in[3]) / 255.0F);
        }
}

} // namespace ramus::render
