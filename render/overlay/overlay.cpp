#include "render/overlay/overlay.h"

#include "render/overlay/captions.h"
#include "render/overlay/legend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <sstream>

namespace ramus::render {

namespace {

// "0.002", "20": a step of the scale bar, whatever its power of ten.
std::string plain_number(double value) {
    std::ostringstream text;
    text << value; // six digits, of which a step has one
    return text.str();
}

int rounded(double value) { return static_cast<int>(std::lround(value)); }

} // namespace

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

Image paint_scale_bar(double length_mm, double length_pixels, double pixel_ratio, bool unit_known) {
    const int line = std::max(1, rounded(1.5 * pixel_ratio)), tick = std::max(3, rounded(5.0 * pixel_ratio));
    const int halo = std::max(1, rounded(pixel_ratio));
    const int length = std::max(line, rounded(length_pixels));
    const Coverage label = draw_text(scale_bar_label(length_mm, unit_known), 9.5 * pixel_ratio);
    const int gap = rounded(2.0 * pixel_ratio);
    const int width = std::max(length, label.width) + 2 * halo, height = label.height + gap + tick + line + 2 * halo;

    Coverage ink(width, height);
    const int label_left = (width - label.width) / 2, bar_left = (width - length) / 2, bar_top = height - halo - line;
    ink.put(label_left, halo, label);
    for (int x = 0; x < length; ++x)
        for (int y = 0; y < line; ++y) ink.put(bar_left + x, bar_top + y, 255);
    for (int y = 0; y < tick; ++y)
        for (int x = 0; x < line; ++x) {
            ink.put(bar_left + x, bar_top - y, 255);
            ink.put(bar_left + length - 1 - x, bar_top - y, 255);
        }

    return haloed(ink, halo);
}

// What sprites have to keep to: smaller pictures have smaller ones, nearer to the edge.
struct OverlayPainter::Space {
    glm::ivec2 corner, free; // upper left and size of what nothing else takes
    bool readable;
    double ratio;
    int margin;
    int top, bottom; // of what is left between sprites at the left side

    explicit Space(const SpriteSource& frame)
        : corner(frame.overlays.inset_left, frame.overlays.inset_top),
          free(frame.size - corner - glm::ivec2(frame.overlays.inset_right, frame.overlays.inset_bottom)) {
        const int least = std::min(free.x, free.y);
        readable = least >= 120;
        ratio = std::clamp<double>(frame.pixel_ratio, 0.5, 8.0) * (least < 400 ? 0.8 : 1.0);
        margin = rounded(std::min(16.0 * ratio, 0.03 * least));
        top = corner.y;
        bottom = corner.y + free.y - margin;
    }
};

std::optional<Sprite> OverlayPainter::caption(const SpriteSource& frame, const Space& space) const {
    if (!space.readable || frame.overlays.caption.empty()) return {};
    return Sprite{paint_caption(frame.overlays.caption, space.ratio, space.free.x - 2 * space.margin),
                  space.corner + space.margin};
}

int OverlayPainter::caption_bottom(const SpriteSource& frame) const {
    const auto found = caption(frame, Space(frame));
    return found ? found->corner.y + found->image.height : 0;
}

Image OverlayPainter::heading(const std::string& text, const SpriteSource& frame) const {
    const Space space(frame);
    return paint_caption(text, 0.9 * space.ratio, space.free.x - 2 * space.margin);
}

void OverlayPainter::add_cube(const Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) const {
    const int side = rounded(std::min(96.0 * space.ratio, 0.22 * std::min(space.free.x, space.free.y)));
    sprites.push_back({cube_.paint(frame.camera, side, frame.overlays.axes),
                       {space.corner.x + space.free.x - space.margin - side, space.bottom - side}});
}

void OverlayPainter::add_scale_bar(Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) const {
    const double mm = mm_per_pixel(frame.camera, frame.size);
    if (!(std::isfinite(mm) && mm > 1e-9 && mm < 1e9)) return;
    const double length = scale_bar_length_mm(mm * std::min(150.0 * space.ratio, 0.30 * space.free.x));
    Image bar = paint_scale_bar(length, length / mm, space.ratio, frame.overlays.unit_known);
    const glm::ivec2 corner(space.corner.x + space.margin, space.bottom - bar.height);
    space.bottom = corner.y - rounded(10.0 * space.ratio);
    sprites.push_back({std::move(bar), corner});
}

void OverlayPainter::add_words(Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) const {
    const Overlays& o = frame.overlays;
    if (auto words = caption(frame, space)) {
        space.top = words->corner.y + words->image.height;
        sprites.push_back(std::move(*words));
    }
    if (o.heading.empty()) return;
    Image words = heading(o.heading, frame);
    const int top = space.top + space.margin / 2;
    space.top = top + words.height;
    const int left = space.corner.x + (space.free.x - words.width) / 2;
    sprites.push_back({std::move(words), {left, top}});
}

void OverlayPainter::add_letters(const Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) const {
    const CameraAxes axes = axes_of(frame.camera);
    const auto add = [&](const glm::dvec3& direction, double x, double y) {
        Image image = paint_caption(orientation_letters(direction, frame.overlays.axes), space.ratio, space.free.x);
        const glm::dvec2 left = glm::dvec2(space.free) - glm::dvec2(image.width, image.height) - double(space.margin);
        const glm::ivec2 corner(rounded(space.corner.x + 0.5 * space.margin + x * left.x),
                                rounded(space.corner.y + 0.5 * space.margin + y * left.y));
        sprites.push_back({std::move(image), {corner.x, y == 0.0 ? std::max(corner.y, space.top) : corner.y}});
    };
    add(-axes.right, 0.0, 0.5);
    add(axes.right, 1.0, 0.5);
    add(axes.up, 0.5, 0.0);
    add(-axes.up, 0.5, 1.0);
}

void OverlayPainter::add_legend(const Space& space, const Legend& legend, std::vector<Sprite>& sprites) const {
    const glm::ivec2 most(space.free.x / 2, space.bottom - space.top - space.margin);
    if (legend.title.empty() || most.x <= 60 || most.y <= 60) return;
    Image image = paint_legend(legend, space.ratio, most);
    const glm::ivec2 corner(space.corner.x + space.margin, space.bottom - image.height);
    sprites.push_back({std::move(image), corner});
}

// Beside its point, and whole inside the picture; where the point is outside, there is no label.
void OverlayPainter::add_label(const Space& space, const SpriteSource& frame, const MarkLabel& label,
                               std::vector<Sprite>& sprites) const {
    const auto at = project(frame.camera, frame.size, label.at);
    if (!at || label.text.empty()) return;
    if (at->x < 0.0 || at->y < 0.0 || at->x >= frame.size.x || at->y >= frame.size.y) return;
    Image plate = paint_label(label.text, space.ratio);
    const double gap = 8.0 * space.ratio;
    const glm::ivec2 beside(std::lround(at->x + gap), std::lround(at->y - gap - plate.height));
    const glm::ivec2 most = glm::max(frame.size - glm::ivec2(plate.width, plate.height), glm::ivec2(0));
    const glm::ivec2 corner = glm::clamp(beside, glm::ivec2(0), most);
    sprites.push_back({std::move(plate), corner});
}

std::vector<Sprite> OverlayPainter::paint(const SpriteSource& frame) const {
    std::vector<Sprite> sprites;
    const Overlays& o = frame.overlays;
    Space space(frame);
    if (!space.readable) return sprites;
    if (o.orientation_cube) add_cube(space, frame, sprites);
    if (o.scale_bar) add_scale_bar(space, frame, sprites);
    add_words(space, frame, sprites);
    if (o.orientation_letters) add_letters(space, frame, sprites);
    add_legend(space, o.legend, sprites);
    for (const MarkLabel& label : frame.labels) add_label(space, frame, label, sprites);
    return sprites;
}

} // namespace ramus::render
