#include "render/overlay/scale_bar.h"

#include "render/image/text.h"
#include "render/overlay/captions.h"
#include "render/scene/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ramus::render {

namespace {

constexpr double kUnspoken = 0.02; // negligible relative difference

// "0.002", "20": a step of the scale bar without exponent.
std::string plain_number(double value) {
    std::ostringstream text;
    text << value; // six digits, of which a step has one
    return text.str();
}

int whole_pixels(double value) { return static_cast<int>(std::lround(value)); }

} // namespace

std::optional<Scale> scale_at(const Camera& camera, glm::ivec2 size, const glm::dvec3& point, Scale::At at) {
    const double depth = depth_of(camera, point);
    if (camera.orthographic || !(depth > 0.0)) return {};
    return Scale{at, mm_per_pixel_at(camera, size, depth), 0.0};
}

std::optional<Scale> scale_of(const Camera& camera, glm::ivec2 size, const Visible& visible) {
    auto scale = scale_at(camera, size, visible.middle, Scale::At::kMiddle);
    if (!scale) return {};
    scale->share = visible.half_depth_mm / depth_of(camera, visible.middle);
    if (!(scale->share <= kMostShare)) return {};
    return scale;
}

std::string_view name_of_place(std::optional<Scale::At> at) {
    if (!at) return "everywhere";
    return *at == Scale::At::kPointer ? "pointer" : *at == Scale::At::kPivot ? "pivot" : "middle";
}

std::optional<ScaleBar> scale_bar_of(const Camera& camera, glm::ivec2 size, const std::optional<Scale>& scale,
                                     double most_pixels) {
    if (!camera.orthographic && !scale) return {};
    const double mm = camera.orthographic ? mm_per_pixel_at(camera, size, 0.0) : scale->mm_per_pixel;
    if (!(std::isfinite(mm) && mm > 1e-9 && mm < 1e9)) return {};
    ScaleBar bar;
    bar.length_mm = scale_bar_length_mm(mm * most_pixels);
    bar.pixels = bar.length_mm / mm;
    if (camera.orthographic) return bar;
    bar.at = scale->at;
    if (scale->share > kUnspoken) bar.percent = static_cast<int>(std::ceil(100.0 * scale->share));
    return bar;
}

double scale_bar_length_mm(double longest_mm) {
    const double power = std::pow(10.0, std::floor(std::log10(longest_mm)));
    for (const double step : {5.0, 2.0})
        if (step * power <= longest_mm) return step * power;
    return power;
}

std::string scale_bar_label(double length_mm, bool unit_known) {
    const auto text = [](double value) {
        std::string digits = std::to_string(value);
        while (digits.back() == '0') digits.pop_back();
        if (digits.back() == '.') digits.pop_back();
        return digits;
    };
    if (!unit_known) return plain_number(length_mm) + (length_mm == 1.0 ? " unit" : " units");
    if (length_mm < 0.99e-3) return text(1e6 * length_mm) + " nm";
    if (length_mm < 0.99) return text(1e3 * length_mm) + " \xb5m";
    if (length_mm > 150.0) return text(0.1 * length_mm) + " cm";
    return text(length_mm) + " mm";
}

std::string place_of(const ScaleBar& bar) {
    if (!bar.at) return {};
    std::string place = "at the " + std::string(name_of_place(bar.at));
    if (bar.percent > 0) place += ", \xb1" + std::to_string(bar.percent) + " %";
    return place;
}

// The length is centred above the bar; the place where it holds is below, left-aligned.
Image paint_scale_bar(const ScaleBar& bar, double pixel_ratio) {
    const int line = std::max(1, whole_pixels(1.5 * pixel_ratio)), tick = std::max(3, whole_pixels(5.0 * pixel_ratio));
    const int halo = std::max(2, whole_pixels(2.0 * pixel_ratio)), gap = whole_pixels(2.0 * pixel_ratio);
    const int length = std::max(line, whole_pixels(bar.pixels));
    const Coverage label = draw_text(scale_bar_label(bar.length_mm, bar.unit_known), 9.5 * pixel_ratio);
    const std::string where = place_of(bar);
    const Coverage place = where.empty() ? Coverage() : draw_text(where, 7.5 * pixel_ratio);
    const int below = where.empty() ? 0 : place.height + gap;
    const int bar_left = halo + std::max(0, (label.width - length) / 2), bar_top = halo + label.height + gap + tick;
    const int width = std::max({bar_left + length, label.width + halo, place.width + halo}) + halo;

    Coverage ink(width, bar_top + line + below + halo);
    ink.put(std::max(halo, bar_left + (length - label.width) / 2), halo, label);
    if (!where.empty()) ink.put(halo, bar_top + line + gap, place);
    for (int x = 0; x < length; ++x)
        for (int y = 0; y < line; ++y) ink.put(bar_left + x, bar_top + y, 255);
    for (int y = 0; y < tick; ++y)
        for (int x = 0; x < line; ++x) {
            ink.put(bar_left + x, bar_top - y, 255);
            ink.put(bar_left + length - 1 - x, bar_top - y, 255);
        }
    return haloed(ink, halo);
}

} // namespace ramus::render
