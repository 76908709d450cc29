#include "render/overlay/overlay.h"

#include "render/overlay/captions.h"
#include "render/overlay/legend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace ramus::render {

namespace {

int rounded(double value) { return static_cast<int>(std::lround(value)); }

Image inked(Image words, const SpriteSource& frame) {
    return frame.overlays.dark_ink ? with_dark_ink(std::move(words)) : std::move(words);
}

PlateInk ink_of(const SpriteSource& frame) { return frame.overlays.dark_ink ? PlateInk::kDark : PlateInk::kLight; }

} // namespace

// The space for sprites: smaller pictures have smaller sprites, nearer to the edge.
struct OverlayPainter::Space {
    glm::ivec2 corner, free; // upper left corner and size of the free area
    bool readable;
    double ratio;
    int margin;
    int top, bottom; // of the free space at the left side

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
    return Sprite{inked(paint_caption(frame.overlays.caption, space.ratio, space.free.x - 2 * space.margin), frame),
                  space.corner + space.margin};
}

int OverlayPainter::caption_bottom(const SpriteSource& frame) const {
    const auto found = caption(frame, Space(frame));
    return found ? found->corner.y + found->image.height : 0;
}

Image OverlayPainter::heading(const std::string& text, const SpriteSource& frame) const {
    const Space space(frame);
    return inked(paint_caption(text, 0.9 * space.ratio, space.free.x - 2 * space.margin), frame);
}

void OverlayPainter::add_cube(const Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) {
    const int side = rounded(std::min(96.0 * space.ratio, 0.22 * std::min(space.free.x, space.free.y)));
    if (cube_image_.width != side || cube_of_ != frame.camera || cube_axes_ != frame.overlays.axes) {
        cube_image_ = cube_.paint(frame.camera, side, frame.overlays.axes);
        cube_of_ = frame.camera;
        cube_axes_ = frame.overlays.axes;
    }
    sprites.push_back({cube_image_, {space.corner.x + space.free.x - space.margin - side, space.bottom - side}});
}

std::optional<ScaleBar> OverlayPainter::scale_bar(const Space& space, const SpriteSource& frame) {
    if (!frame.overlays.scale_bar || !space.readable) return {};
    auto bar = scale_bar_of(frame.camera, frame.size, frame.overlays.scale,
                            std::min(150.0 * space.ratio, 0.30 * space.free.x));
    if (bar) bar->unit_known = frame.overlays.unit_known;
    return bar;
}

std::optional<ScaleBar> OverlayPainter::scale_bar(const SpriteSource& frame) { return scale_bar(Space(frame), frame); }

void OverlayPainter::add_scale_bar(Space& space, const SpriteSource& frame, std::vector<Sprite>& sprites) {
    const auto found = scale_bar(space, frame);
    if (!found) return;
    Image bar = inked(paint_scale_bar(*found, space.ratio), frame);
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
        Image image =
            inked(paint_caption(orientation_letters(direction, frame.overlays.axes), space.ratio, space.free.x), frame);
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

void OverlayPainter::add_legend(const Space& space, const SpriteSource& frame, const Legend& legend,
                                std::vector<Sprite>& sprites) const {
    const glm::ivec2 most(space.free.x / 2, space.bottom - space.top - space.margin);
    if (legend.title.empty() || most.x <= 60 || most.y <= 60) return;
    Image image = paint_legend(legend, space.ratio, most, ink_of(frame));
    const glm::ivec2 corner(space.corner.x + space.margin, space.bottom - image.height);
    sprites.push_back({std::move(image), corner});
}

namespace {

bool overlap(const glm::ivec2& corner, const Image& image, const Sprite& other) {
    const glm::ivec2 end = corner + glm::ivec2(image.width, image.height);
    const glm::ivec2 other_end = other.corner + glm::ivec2(other.image.width, other.image.height);
    return glm::all(glm::lessThan(corner, other_end)) && glm::all(glm::lessThan(other.corner, end));
}

} // namespace

// Places the label above and to the right of its point, completely inside the picture; if that is occupied, at the next
// free place around the point, or farther up or down. No label if the point is outside.
void OverlayPainter::add_label(const Space& space, const SpriteSource& frame, const MarkLabel& label,
                               std::vector<Sprite>& sprites) const {
    const auto at = project(frame.camera, frame.size, label.at);
    if (!at || label.text.empty()) return;
    if (at->x < 0.0 || at->y < 0.0 || at->x >= frame.size.x || at->y >= frame.size.y) return;
    Image plate = paint_label(label.text, space.ratio, ink_of(frame));
    const double gap = 8.0 * space.ratio;
    const glm::ivec2 most = glm::max(frame.size - glm::ivec2(plate.width, plate.height), glm::ivec2(0));
    const auto place = [&](bool left, bool below, int rows) {
        const double x = left ? at->x - gap - plate.width : at->x + gap;
        const double y = below ? at->y + gap + rows * plate.height : at->y - gap - (1 + rows) * plate.height;
        return glm::clamp(glm::ivec2(std::lround(x), std::lround(y)), glm::ivec2(0), most);
    };
    const auto is_free = [&](const glm::ivec2& corner) {
        return std::ranges::none_of(sprites, [&](const Sprite& other) { return overlap(corner, plate, other); });
    };
    glm::ivec2 corner = place(false, false, 0);
    constexpr int kPlaces = 12;
    for (int n = 0; n < kPlaces; ++n)
        if (const glm::ivec2 next = place((n & 2) != 0, (n & 1) != 0, n / 4); is_free(next)) {
            corner = next;
            break;
        }
    sprites.push_back({std::move(plate), corner});
}

std::vector<Sprite> OverlayPainter::paint(const SpriteSource& frame) {
    std::vector<Sprite> sprites;
    const Overlays& o = frame.overlays;
    Space space(frame);
    if (!space.readable) return sprites;
    if (o.orientation_cube) add_cube(space, frame, sprites);
    add_scale_bar(space, frame, sprites);
    add_words(space, frame, sprites);
    if (o.orientation_letters) add_letters(space, frame, sprites);
    add_legend(space, frame, o.legend, sprites);
    for (const MarkLabel& label : frame.labels) add_label(space, frame, label, sprites);
    return sprites;
}

} // namespace ramus::render
