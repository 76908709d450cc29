#include "render/overlay/legend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

namespace ramus::render {

namespace {

struct Inks {
    glm::vec3 ground, text, quiet;
};
constexpr Inks kLightOnDark{{0.051F, 0.059F, 0.071F}, {0.89F, 0.90F, 0.92F}, {0.66F, 0.68F, 0.72F}};
constexpr Inks kDarkOnLight{{0.98F, 0.98F, 0.985F}, {0.10F, 0.12F, 0.14F}, {0.36F, 0.39F, 0.43F}};
const Inks& inks_of(PlateInk ink) { return ink == PlateInk::kDark ? kDarkOnLight : kLightOnDark; }

// A small plate with text and patches of colour. Straight alpha, sRGB.
class Plate {
public:
    // Round corners of `radius` pixels; `opacity` 0 to 1.
    Plate(int width, int height, double radius, double opacity, const glm::vec3& ground) : image_(width, height) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double dx = std::max({radius - (x + 0.5), x + 0.5 - (width - radius), 0.0});
                const double dy = std::max({radius - (y + 0.5), y + 0.5 - (height - radius), 0.0});
                const double share = std::clamp(radius - std::hypot(dx, dy) + 0.5, 0.0, 1.0);
                std::uint8_t* out = image_.pixel(x, y);
                for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(std::lround(255.0F * ground[k]));
                out[3] = static_cast<std::uint8_t>(std::lround(255.0 * opacity * share));
            }
    }

    // Fills a rectangle; coordinates in fractional pixels.
    void fill(double left, double top, double width, double height, const glm::vec3& srgb) {
        const auto covered = [](int pixel, double from, double to) {
            return std::clamp(std::min(pixel + 1.0, to) - std::max(double(pixel), from), 0.0, 1.0);
        };
        for (int y = int(std::floor(top)); y < std::ceil(top + height); ++y)
            for (int x = int(std::floor(left)); x < std::ceil(left + width); ++x)
                lay(x, y, srgb, covered(x, left, left + width) * covered(y, top, top + height));
    }

    void write(const Coverage& text, int left, int top, const glm::vec3& srgb) {
        for (int y = 0; y < text.height; ++y)
            for (int x = 0; x < text.width; ++x) lay(left + x, top + y, srgb, text.at(x, y) / 255.0);
    }

    [[nodiscard]] Image take() && { return std::move(image_); }

private:
    void lay(int x, int y, const glm::vec3& srgb, double share) {
        if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || share <= 0.0) return;
        std::uint8_t* out = image_.pixel(x, y);
        const double below = out[3] / 255.0 * (1.0 - share), alpha = share + below;
        for (int k = 0; k < 3; ++k)
            out[k] = static_cast<std::uint8_t>(std::lround((255.0 * srgb[k] * share + out[k] * below) / alpha));
        out[3] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
    }

    Image image_;
};

glm::vec3 at(const std::vector<glm::vec3>& bar, double t) {
    const double along = std::clamp(t, 0.0, 1.0) * static_cast<double>(bar.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(along), bar.size() > 1 ? bar.size() - 2 : 0);
    const auto above = std::min(below + 1, bar.size() - 1);
    return glm::mix(bar[below], bar[above], static_cast<float>(along - static_cast<double>(below)));
}

// Diagonal stripes, as lost parts are drawn.
void hatch(Plate& plate, int left, int top, int width, int height, double period, const glm::vec3& srgb) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double phase = (x - y) / period - std::floor((x - y) / period);
            plate.fill(left + x, top + y, 1, 1, glm::min(srgb * (phase < 0.45 ? 1.3F : 0.62F), 1.0F));
        }
}

} // namespace

Image paint_label(const std::string& text, double pixel_ratio, PlateInk ink) {
    const Inks& inks = inks_of(ink);
    const Coverage letters = draw_text(text, 8.5 * pixel_ratio);
    const int side = static_cast<int>(std::lround(5.0 * pixel_ratio)),
              edge = static_cast<int>(std::lround(1.0 * pixel_ratio));
    Plate plate(letters.width + 2 * side, letters.height + 2 * edge, 3.0 * pixel_ratio, 0.85, inks.ground);
    plate.write(letters, side, edge, inks.text);
    return std::move(plate).take();
}

Image paint_legend(const Legend& legend, double pixel_ratio, glm::ivec2 most, PlateInk ink) {
    const Inks& inks = inks_of(ink);
    const auto pixels = [&](double points) { return std::max(1, static_cast<int>(std::lround(points * pixel_ratio))); };
    const auto text = [&](const std::string& words, double size = 8.0) { return draw_text(words, size * pixel_ratio); };
    const int margin = pixels(8), gap = pixels(6), row = pixels(17), patch = pixels(11), bar_width = pixels(12);
    const Coverage title = text(legend.title, 8.5), subtitle = text(legend.subtitle, 7.5);
    const int below_title = margin + title.height, subtitle_room = legend.subtitle.empty() ? 0 : subtitle.height;
    const int head = below_title + subtitle_room + pixels(3);

    int width = std::max(title.width, subtitle.width), height = head + margin;
    std::vector<Coverage> ticks, labels;
    int bar_height = 0, tick_room = 0;
    if (!legend.bar.empty()) {
        for (const Legend::Tick& tick : legend.ticks) ticks.push_back(text(tick.text));
        for (const Coverage& tick : ticks)
            width = std::max(width, bar_width + gap + tick.width), tick_room = std::max(tick_room, tick.height / 2);
        bar_height = std::clamp(most.y - head - margin - 2 * tick_room, pixels(40), pixels(130));
        height += bar_height + 2 * tick_room;
    }
    const std::size_t rows = static_cast<std::size_t>(std::max(1, (most.y - height) / row));
    const std::size_t shown = legend.swatches.size() <= rows ? legend.swatches.size() : rows - 1;
    for (std::size_t i = 0; i < shown; ++i) labels.push_back(text(legend.swatches[i].text));
    if (shown < legend.swatches.size())
        labels.push_back(text("and " + std::to_string(legend.swatches.size() - shown) + " more"));
    for (const Coverage& label : labels) width = std::max(width, patch + gap + label.width);
    height += row * static_cast<int>(labels.size());

    Plate plate(std::min(width + 2 * margin, most.x), height, 4.0 * pixel_ratio, 0.85, inks.ground);
    plate.write(title, margin, margin - pixels(2), inks.text);
    plate.write(subtitle, margin, below_title - pixels(2), inks.quiet);
    int top = head;
    if (!legend.bar.empty()) {
        top += tick_room;
        for (int y = 0; y < bar_height; ++y)
            plate.fill(margin, top + y, bar_width, 1, at(legend.bar, 1.0 - (y + 0.5) / bar_height));
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const double y = top + (1.0 - std::clamp(legend.ticks[i].at, 0.0, 1.0)) * bar_height;
            const double line = std::max(1.0, std::round(pixel_ratio));
            plate.fill(margin + bar_width, std::round(y - 0.5 * line), pixels(3), line, inks.quiet);
            plate.write(ticks[i], margin + bar_width + gap, static_cast<int>(std::lround(y)) - ticks[i].height / 2,
                        inks.text);
        }
        top += bar_height + tick_room;
    }
    for (std::size_t i = 0; i < labels.size(); ++i, top += row) {
        const int middle = top + row / 2;
        if (i < shown) {
            const Legend::Swatch& swatch = legend.swatches[i];
            const int patch_top = middle - patch / 2;
            if (swatch.hatched)
                hatch(plate, margin, patch_top, patch, patch, 4.5 * pixel_ratio, swatch.colour);
            else
                plate.fill(margin, patch_top, patch, patch, swatch.colour);
        }
        plate.write(labels[i], margin + patch + gap, middle - labels[i].height / 2, i < shown ? inks.text : inks.quiet);
    }
    return std::move(plate).take();
}

} // namespace ramus::render
