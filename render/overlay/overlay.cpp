#include "render/overlay/overlay.h"

#include "render/image/text.h"
#include "render/overlay/captions.h"
#include "render/overlay/legend.h"
#include "render/overlay/plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

namespace ramus::render {

namespace {

constexpr int kLetterSide = 64; // texels of a face's letter
constexpr int kSubsamples = 4;  // a side: 16 rays a pixel

// The six faces in RAS: outward normal, and right and up of its letter as its standard view shows it.
struct Face {
    char letter;
    glm::dvec3 normal, right, up;
    glm::dvec3 colour; // linear
};
const std::array<Face, 6> kFaces{{
    {'R', {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.155, 0.095, 0.088}},
    {'L', {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.155, 0.095, 0.088}},
    {'A', {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0.088, 0.128, 0.098}},
    {'P', {0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {0.088, 0.128, 0.098}},
    {'S', {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.084, 0.108, 0.160}},
    {'I', {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {0.084, 0.108, 0.160}},
}};

Coverage letter_tile(char letter, const std::string& font) {
    const Coverage drawn = draw_text(std::string(1, letter), 0.56 * kLetterSide, font);
    int left = drawn.width, right = -1, top = drawn.height, bottom = -1;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            if (drawn.at(x, y) > 8)
                left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
                bottom = std::max(bottom, y);
    Coverage tile;
    tile.width = tile.height = kLetterSide;
    tile.values.resize(kLetterSide * kLetterSide);
    const int dx = (left + right + 1 - kLetterSide) / 2, dy = (top + bottom + 1 - kLetterSide) / 2;
    for (int y = 0; y < kLetterSide; ++y)
        for (int x = 0; x < kLetterSide; ++x)
            tile.values[static_cast<std::size_t>(y * kLetterSide + x)] = drawn.at(x + dx, y + dy);
    return tile;
}

double sampled(const Coverage& tile, double u, double v) { // u, v in [0, 1] from the top left, linear
    const double x = u * tile.width - 0.5, y = v * tile.height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return ((1 - fy) * ((1 - fx) * tile.at(x0, y0) + fx * tile.at(x0 + 1, y0)) +
            fy * ((1 - fx) * tile.at(x0, y0 + 1) + fx * tile.at(x0 + 1, y0 + 1))) /
           255.0;
}

std::uint8_t srgb_byte(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return static_cast<std::uint8_t>(
        std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055)));
}

} // namespace

double scale_bar_length_mm(double longest_mm) {
    const double power = std::pow(10.0, std::floor(std::log10(longest_mm)));
    for (const double step : {5.0, 2.0})
        if (step * power <= longest_mm) return step * power;
    return power;
}

std::string scale_bar_label(double length_mm) {
    const auto text = [](double value) {
        std::string digits = std::to_string(value);
        while (digits.back() == '0') digits.pop_back();
        if (digits.back() == '.') digits.pop_back();
        return digits;
    };
    if (length_mm < 0.99e-3) return text(1e6 * length_mm) + " nm";
    if (length_mm < 0.99) return text(1e3 * length_mm) + " \xb5m";
    if (length_mm > 150.0) return text(0.1 * length_mm) + " cm";
    return text(length_mm) + " mm";
}

Image paint_orientation_cube(const Camera& camera, int side, const std::string& font) {
    static thread_local std::pair<std::string, std::array<Coverage, 6>> kept; // the cube turns in every frame
    if (kept.first != font || kept.second[0].width == 0) {
        kept.first = font;
        for (std::size_t i = 0; i < 6; ++i) kept.second[i] = letter_tile(kFaces[i].letter, font);
    }
    const std::array<Coverage, 6>& letters = kept.second;

    const CameraAxes axes = axes_of(camera);
    const glm::dvec3 light = glm::normalize(-0.35 * axes.right + 0.55 * axes.up - 0.9 * axes.forward);
    std::array<double, 3> ahead{}, inverse{}; // of the rays' direction: its sign, 1 / it
    for (int k = 0; k < 3; ++k) {
        ahead[k] = std::copysign(1.0, axes.forward[k]);
        inverse[k] =
            1.0 / (std::abs(axes.forward[k]) < 1e-12 ? std::copysign(1e-12, axes.forward[k]) : axes.forward[k]);
    }
    Image image(side, side);
    const double extent = 1.76; // half the picture in units of half the cube: a corner never leaves it
    struct Hit {
        int face = -1;
        glm::dvec3 colour{0.0};
    };
    // Parallel rays: the nearest entry into the three slabs is the face that is seen.
    const auto cast = [&](double sx, double sy) -> Hit {
        const glm::dvec3 start = extent * ((2.0 * sx / side - 1.0) * axes.right + (1.0 - 2.0 * sy / side) * axes.up);
        double entry = -1e9, exit = 1e9;
        int face = 0;
        for (int k = 0; k < 3; ++k) {
            const double near = (-ahead[k] - start[k]) * inverse[k], far = (ahead[k] - start[k]) * inverse[k];
            if (near > entry) {
                entry = near;
                face = 2 * k + (ahead[k] > 0.0 ? 1 : 0);
            }
            exit = std::min(exit, far);
        }
        if (entry > exit) return {};
        const Face& f = kFaces[static_cast<std::size_t>(face)];
        const glm::dvec3 point = start + entry * axes.forward;
        const double u = 0.5 + 0.5 * glm::dot(point, f.right), v = 0.5 - 0.5 * glm::dot(point, f.up);
        const double edge = 2.0 * std::min(std::min(u, 1.0 - u), std::min(v, 1.0 - v));
        const double lit = 0.55 + 0.60 * std::max(0.0, glm::dot(f.normal, light));
        glm::dvec3 colour = f.colour * lit;
        if (edge < 0.07) colour = 1.5 * colour + 0.04;
        return {face, glm::mix(colour, glm::dvec3(0.90, 0.92, 0.95) * std::min(1.0, 0.35 + 0.7 * lit),
                               sampled(letters[static_cast<std::size_t>(face)], u, v))};
    };
    for (int py = 0; py < side; ++py) {
        for (int px = 0; px < side; ++px) {
            glm::dvec3 sum(0.0);
            int hits = 0, rays = 0;
            const auto add = [&](int column, int row) {
                ++rays;
                const Hit hit = cast(px + (column + 0.5) / kSubsamples, py + (row + 0.5) / kSubsamples);
                if (hit.face >= 0) ++hits, sum += hit.colour;
                return hit;
            };
            // Where all corners see the same plain colour, so does what lies between.
            constexpr int kLast = kSubsamples - 1;
            const std::array<Hit, 4> corners{add(0, 0), add(kLast, 0), add(0, kLast), add(kLast, kLast)};
            const bool plain = std::ranges::all_of(corners, [&](const Hit& hit) {
                return hit.face == corners[0].face && hit.colour == corners[0].colour;
            });
            for (int s = 0; s < kSubsamples * kSubsamples && !plain; ++s) {
                const int column = s % kSubsamples, row = s / kSubsamples;
                if ((column == 0 || column == kLast) && (row == 0 || row == kLast)) continue;
                (void)add(column, row);
            }
            if (hits == 0) continue;
            sum /= hits;
            std::uint8_t* out = image.pixel(px, py);
            for (int k = 0; k < 3; ++k) out[k] = srgb_byte(sum[k]);
            out[3] = static_cast<std::uint8_t>(std::lround(235.0 * hits / rays));
        }
    }
    return image;
}

Image paint_scale_bar(double length_mm, double length_pixels, double pixel_ratio, const std::string& font) {
    const int line = std::max(1, static_cast<int>(std::lround(1.5 * pixel_ratio))),
              tick = std::max(3, static_cast<int>(std::lround(5.0 * pixel_ratio)));
    const int halo = std::max(1, static_cast<int>(std::lround(pixel_ratio)));
    const int length = std::max(line, static_cast<int>(std::lround(length_pixels)));
    const Coverage label = draw_text(scale_bar_label(length_mm), 9.5 * pixel_ratio, font);
    const int gap = static_cast<int>(std::lround(2.0 * pixel_ratio));
    const int width = std::max(length, label.width) + 2 * halo, height = label.height + gap + tick + line + 2 * halo;

    Coverage ink;
    ink.width = width;
    ink.height = height;
    ink.values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    const auto put = [&](int x, int y, std::uint8_t value) {
        auto& old =
            ink.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        old = std::max(old, value);
    };
    const int label_left = (width - label.width) / 2, bar_left = (width - length) / 2, bar_top = height - halo - line;
    for (int y = 0; y < label.height; ++y)
        for (int x = 0; x < label.width; ++x) put(label_left + x, halo + y, label.at(x, y));
    for (int x = 0; x < length; ++x)
        for (int y = 0; y < line; ++y) put(bar_left + x, bar_top + y, 255);
    for (int y = 0; y < tick; ++y)
        for (int x = 0; x < line; ++x) {
            put(bar_left + x, bar_top - y, 255);
            put(bar_left + length - 1 - x, bar_top - y, 255);
        }

    return haloed(ink, halo);
}

namespace {

// What sprites have to keep to: smaller pictures have smaller ones, nearer to the edge.
struct Room {
    glm::ivec2 free; // what nothing else takes
    bool readable;
    double ratio;
    int margin;
    explicit Room(const SpriteSource& frame)
        : free(frame.size - glm::ivec2(frame.overlays.inset_left + frame.overlays.inset_right,
                                       frame.overlays.inset_top + frame.overlays.inset_bottom)) {
        const int least = std::min(free.x, free.y);
        readable = least >= 120;
        ratio = std::clamp<double>(frame.pixel_ratio, 0.5, 8.0) * (least < 400 ? 0.8 : 1.0);
        margin = static_cast<int>(std::lround(std::min(16.0 * ratio, 0.03 * least)));
    }
};

std::optional<Sprite> caption_of(const SpriteSource& frame, const Room& room, const std::string& font) {
    const Overlays& o = frame.overlays;
    if (!room.readable || o.caption.empty()) return {};
    return Sprite{paint_caption(o.caption, room.ratio, room.free.x - 2 * room.margin, font),
                  {o.inset_left + room.margin, o.inset_top + room.margin}};
}

} // namespace

int caption_bottom(const SpriteSource& frame, const std::string& font) {
    const auto caption = caption_of(frame, Room(frame), font);
    return caption ? caption->corner.y + caption->image.height : 0;
}

Image paint_heading(const std::string& text, const SpriteSource& frame, const std::string& font) {
    const Room room(frame);
    return paint_caption(text, 0.9 * room.ratio, room.free.x - 2 * room.margin, font);
}

std::vector<Sprite> overlays_of(const SpriteSource& frame, const std::string& font) {
    std::vector<Sprite> sprites;
    const Overlays& o = frame.overlays;
    const Room all(frame);
    if (!all.readable) return sprites;
    const glm::ivec2 free = all.free;
    const double ratio = all.ratio;
    const int least = std::min(free.x, free.y), margin = all.margin;
    const int bottom = frame.size.y - o.inset_bottom - margin;
    if (o.orientation_cube) {
        const int side = static_cast<int>(std::lround(std::min(96.0 * ratio, 0.22 * least)));
        sprites.push_back({paint_orientation_cube(frame.camera, side, font),
                           {frame.size.x - o.inset_right - margin - side, bottom - side}});
    }
    int legend_bottom = bottom;
    const double mm = mm_per_pixel(frame.camera, frame.size);
    if (o.scale_bar && std::isfinite(mm) && mm > 1e-9 && mm < 1e9) {
        const double length = scale_bar_length_mm(mm * std::min(150.0 * ratio, 0.30 * free.x));
        Image bar = paint_scale_bar(length, length / mm, ratio, font);
        const glm::ivec2 corner(o.inset_left + margin, bottom - bar.height);
        legend_bottom = corner.y - static_cast<int>(std::lround(10.0 * ratio));
        sprites.push_back({std::move(bar), corner});
    }
    int below_caption = o.inset_top;
    if (auto caption = caption_of(frame, all, font)) {
        below_caption = caption->corner.y + caption->image.height;
        sprites.push_back(std::move(*caption));
    }
    if (!o.heading.empty()) {
        Image heading = paint_heading(o.heading, frame, font);
        const int top = o.caption.empty() ? o.inset_top + margin / 2 : below_caption + margin / 2;
        below_caption = top + heading.height;
        const int left = o.inset_left + (free.x - heading.width) / 2;
        sprites.push_back({std::move(heading), {left, top}});
    }
    if (o.orientation_letters) {
        const CameraAxes axes = axes_of(frame.camera);
        const auto letters = [&](const glm::dvec3& direction, double x, double y) {
            Image image = paint_caption(orientation_letters(direction), ratio, free.x, font);
            const glm::dvec2 room = glm::dvec2(free) - glm::dvec2(image.width, image.height) - glm::dvec2(margin);
            const glm::ivec2 corner(std::lround(o.inset_left + 0.5 * margin + x * room.x),
                                    std::lround(o.inset_top + 0.5 * margin + y * room.y));
            sprites.push_back({std::move(image), {corner.x, y == 0.0 ? std::max(corner.y, below_caption) : corner.y}});
        };
        letters(-axes.right, 0.0, 0.5);
        letters(axes.right, 1.0, 0.5);
        letters(axes.up, 0.5, 0.0);
        letters(-axes.up, 0.5, 1.0);
    }
    const glm::ivec2 room(free.x / 2, legend_bottom - below_caption - margin);
    if (!o.legend.title.empty() && room.x > 60 && room.y > 60) {
        Image legend = paint_legend(o.legend, ratio, room, font);
        const glm::ivec2 corner(o.inset_left + margin, legend_bottom - legend.height);
        sprites.push_back({std::move(legend), corner});
    }
    for (const MarkLabel& label : frame.labels) {
        const auto at = project(frame.camera, frame.size, label.at);
        if (!at || label.text.empty()) continue;
        Image plate = paint_label(label.text, ratio, font);
        // Beside the place, and whole inside the picture; where the place is outside, there is no label.
        if (at->x < 0.0 || at->y < 0.0 || at->x >= frame.size.x || at->y >= frame.size.y) continue;
        const glm::ivec2 wanted(std::lround(at->x + 8.0 * ratio), std::lround(at->y - 8.0 * ratio - plate.height));
        const glm::ivec2 most = glm::max(frame.size - glm::ivec2(plate.width, plate.height), glm::ivec2(0));
        const glm::ivec2 corner = glm::clamp(wanted, glm::ivec2(0), most);
        sprites.push_back({std::move(plate), corner});
    }
    return sprites;
}

} // namespace ramus::render
