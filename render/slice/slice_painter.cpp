#include "render/slice/slice_painter.h"

#include "render/image/canvas.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace ramus::render {

namespace {

constexpr float kToNearest = 0.5F; // rounds positive numbers when their fraction is cut off, faster than lround()

std::uint8_t byte_of(float share) { return static_cast<std::uint8_t>(255.0F * share + kToNearest); }

std::vector<glm::dvec2> pixels_of(const slice::PixelGrid& grid, const std::vector<glm::dvec3>& places) {
    std::vector<glm::dvec2> pixels;
    pixels.reserve(places.size());
    for (const glm::dvec3& place : places) pixels.push_back(grid.pixel(place));
    return pixels;
}

// The values of the label at every pixel, 0 outside.
std::vector<std::int32_t> labels_of(const volume::Volume& mask, const slice::PixelGrid& grid) {
    const std::vector<float> values = slice::sampled(mask, grid, {.interpolation = slice::Interpolation::kNearest});
    std::vector<std::int32_t> labels(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) {
        if (std::isnan(values[n])) continue;
        const bool fractions = !volume::holds_whole_numbers(mask);
        auto label = fractions ? static_cast<std::int32_t>(values[n] >= 0.5F) : static_cast<std::int32_t>(values[n]);
        const auto overlap = std::ranges::find(mask.overlaps, label, &volume::Overlap::value);
        if (overlap != mask.overlaps.end()) label = overlap->labels.back();
        labels[n] = label;
    }
    return labels;
}

void tint(std::uint8_t* pixel, const glm::vec3& colour, float opacity) {
    for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>((1.0F - opacity) * pixel[k] + 255.0F * opacity * colour[k] + kToNearest);
}

} // namespace

namespace {

template <class AnyFrame> auto section_parts(AnyFrame& frame) {
    return std::tie(frame.mesh, frame.states, frame.colours, frame.centerlines, frame.scale, frame.lesions,
                    frame.context, frame.margins, frame.lost, frame.hovered, frame.selected, frame.appearance);
}

} // namespace

Frame section_source(const Frame& frame) {
    Frame source;
    section_parts(source) = section_parts(frame);
    return source;
}

bool same_section(const Frame& a, const Frame& b) { return section_parts(a) == section_parts(b); }

Camera camera_of(const slice::PixelGrid& grid) {
    Camera camera;
    camera.orthographic = true;
    camera.focal_point = grid.place(0.5 * glm::dvec2(grid.size) - 0.5);
    camera.position = camera.focal_point + 500.0 * grid.plane().normal;
    camera.view_up = -glm::normalize(grid.down);
    camera.scale = 0.5 * grid.size.y * glm::length(grid.down);
    return camera;
}

void SlicePainter::sample(const SliceView& view) {
    if (sampled_at_ != view.grid || sampled_by_ != view.sampling) sampled_.clear();
    sampled_at_ = view.grid;
    sampled_by_ = view.sampling;
    sampled_.take(view.scans,
                  [&](const volume::Volume& scan) { return slice::sampled(scan, view.grid, view.sampling); });
}

void SlicePainter::paint_scans(const SliceView& view, Image& image) const {
    for (std::size_t layer = 0; layer < sampled_.all().size(); ++layer) {
        const slice::Window& window = view.scans[layer].window;
        const float opacity = view.scans[layer].opacity;
        const std::vector<float>& values = sampled_.all()[layer].values;
        for (std::size_t n = 0; n < values.size(); ++n) {
            if (std::isnan(values[n])) continue;
            std::uint8_t* const out = image.rgba.data() + 4 * n;
            if (opacity >= 1.0F)
                std::fill(out, out + 3, byte_of(window.grey(values[n])));
            else
                tint(out, glm::vec3(window.grey(values[n])), opacity);
        }
    }
}

void SlicePainter::cut(const Frame& frame, const SliceView& view) {
    const slice::Plane plane = view.grid.plane();
    if (cut_drawn_ && plane == cut_at_ && same_section(frame, cut_of_)) return;
    section_ = cutter_.section(frame, plane);
    cut_of_ = section_source(frame);
    cut_at_ = plane;
    cut_drawn_ = true;
}

void SlicePainter::paint_masks(const SliceView& view, Image& image) const {
    for (const MaskLayer& layer : view.masks) {
        if (!layer.mask) continue;
        const std::vector<std::int32_t> labels = labels_of(*layer.mask, view.grid);
        const int width = image.width;
        const auto label_at = [&](int x, int y) {
            const bool inside = x >= 0 && y >= 0 && x < width && y < image.height;
            return inside ? labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x)]
                          : -1;
        };
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < width; ++x) {
                const std::int32_t label = label_at(x, y);
                const auto look = std::ranges::lower_bound(layer.labels, label, {}, &MaskLayer::Label::label);
                if (look == layer.labels.end() || look->label != label) continue;
                const bool border = label_at(x - 1, y) != label || label_at(x + 1, y) != label ||
                                    label_at(x, y - 1) != label || label_at(x, y + 1) != label;
                tint(image.pixel(x, y), look->colour, border ? layer.border : layer.fill);
            }
    }
}

void SlicePainter::paint_section(const SliceView& view, Image& image) const {
    Canvas canvas(image);
    if (view.outlines) {
        std::map<int, std::vector<std::vector<glm::dvec2>>> filled;
        std::map<int, const SectionLine*> looks;
        for (const SectionLine& line : section_.lines)
            if (line.fill > 0.0F && line.closed) {
                filled[line.group].push_back(pixels_of(view.grid, line.points));
                looks[line.group] = &line;
            }
        for (const auto& [group, polygons] : filled) canvas.area(polygons, looks[group]->colour, looks[group]->fill);
        for (const SectionLine& line : section_.lines)
            canvas.line(pixels_of(view.grid, line.points), line.closed,
                        {line.colour, line.width * view.pixel_ratio, line.opacity});
    }
    if (!view.axes) return;
    for (const AxisCrossing& crossing : section_.crossings) {
        const glm::dvec2 at = view.grid.pixel(crossing.at);
        canvas.dot(at, {glm::vec3(0.0F), 4.2F * view.pixel_ratio, 0.7F});
        canvas.dot(at, {crossing.colour, 2.4F * view.pixel_ratio, 1.0F});
    }
}

namespace {

void paint_crosshair(const SliceView& view, Image& image) {
    if (!view.crosshair) return;
    Canvas canvas(image);
    const glm::dvec2 at = view.grid.pixel(view.crosshair->at);
    const double gap = 9.0 * static_cast<double>(view.pixel_ratio);
    const auto draw = [&](const glm::dvec2& from, const glm::dvec2& to, const glm::vec3& colour) {
        const std::array ends{from, to};
        canvas.line(ends, false, {colour, 1.1F * view.pixel_ratio, 0.75F});
    };
    const double width = image.width;
    const double height = image.height;
    // Ends beyond the picture are kept inside it, since the cost of a line is that of its box.
    if (at.x - gap > 0.0) draw({0.0, at.y}, {std::min(at.x - gap, width), at.y}, view.crosshair->row);
    if (at.x + gap < width) draw({std::max(at.x + gap, 0.0), at.y}, {width, at.y}, view.crosshair->row);
    if (at.y - gap > 0.0) draw({at.x, 0.0}, {at.x, std::min(at.y - gap, height)}, view.crosshair->column);
    if (at.y + gap < height) draw({at.x, std::max(at.y + gap, 0.0)}, {at.x, height}, view.crosshair->column);
}

void paint_mark(const SliceView& view, Image& image) {
    if (!view.mark) return;
    const auto rows = std::min(image.height, static_cast<int>(std::lround(3.0F * view.pixel_ratio)));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < image.width; ++x) tint(image.pixel(x, y), *view.mark, 1.0F);
}

} // namespace

void SlicePainter::paint_marks(const SliceView& view, Image& image) {
    Canvas canvas(image);
    for (const SliceMark& mark : view.marks) {
        const std::vector<glm::dvec2> pixels = pixels_of(view.grid, mark.points);
        // A dark rim, for bright scans.
        canvas.line(pixels, false, {glm::vec3(0.0F), (mark.width + 1.6F) * view.pixel_ratio, 0.5F * mark.opacity});
        canvas.line(pixels, false, {mark.colour, mark.width * view.pixel_ratio, mark.opacity});
    }
}

void SlicePainter::paint_sprites(const SliceView& view, Image& image) {
    Frame frame;
    frame.camera = camera_of(view.grid);
    frame.size = view.grid.size;
    frame.pixel_ratio = view.pixel_ratio;
    frame.overlays = view.overlays;
    frame.labels = view.labels;
    Canvas canvas(image);
    for (const Sprite& sprite : overlays_.paint(SpriteSource(frame))) canvas.picture(sprite.image, sprite.corner);
}

Image SlicePainter::paint_alone(const SliceView& view) {
    Image image(view.grid.size.x, view.grid.size.y);
    sample(view);
    paint_scans(view, image);
    paint_masks(view, image);
    for (const SampledLayer& layer : sampled_.all())
        for (std::size_t n = 0; n < layer.values.size(); ++n)
            if (!std::isnan(layer.values[n])) image.rgba[4 * n + 3] = 255;
    if (sampled_.all().empty()) // labels alone
        for (std::size_t n = 0; n < image.rgba.size(); n += 4)
            if (image.rgba[n] != 0 || image.rgba[n + 1] != 0 || image.rgba[n + 2] != 0) image.rgba[n + 3] = 255;
    return image;
}

Image SlicePainter::paint(const Frame& frame, const SliceView& view) {
    Image image(view.grid.size.x, view.grid.size.y);
    image.fill(view.background);
    if (view.along) {
        along_.paint(frame, view, image);
        paint_mark(view, image);
        paint_sprites(view, image);
        return image;
    }
    sample(view);
    paint_scans(view, image);
    paint_masks(view, image);
    if (view.outlines || view.axes) {
        cut(frame, view);
        paint_section(view, image);
    }
    paint_crosshair(view, image);
    paint_marks(view, image);
    paint_mark(view, image);
    paint_sprites(view, image);
    return image;
}

} // namespace ramus::render
