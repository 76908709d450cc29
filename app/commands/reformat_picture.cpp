#include "app/commands/reformat_picture.h"

#include "app/commands/slice_canvas.h"
#include "app/picture/colouring.h"
#include "render/slice/along_painter.h"

#include <algorithm>
#include <cmath>

namespace ramus::app {

namespace {

constexpr int kRulerWidth = 64, kMargin = 10, kGap = 6;
constexpr double kLineWidth = 1.4;
constexpr glm::vec3 kRulerColour{0.85F}, kMaskColour{1.0F};
constexpr double kMostPixels = 1e8;

Result<void> check_size(double width, double height) {
    if (width * height <= kMostPixels) return {};
    return fail("the picture would have more than 100 million pixels", {},
                "choose a greater --step or a smaller --width");
}

// Paints an outline of the vessel. Those of masks get a dark edge: vessels may be as white as the line.
void put_outline(SliceCanvas& canvas, const slice::Outline& line, const glm::vec3& colour, glm::ivec2 low,
                 glm::ivec2 high) {
    if (colour == kMaskColour) canvas.put_line(line, glm::vec3(0.0F), 2.5 * kLineWidth, low, high);
    canvas.put_line(line, colour, kLineWidth, low, high);
}

class ReformationPainter {
public:
    ReformationPainter(const slice::VesselPath& path, const slice::Reformation& picture)
        : path_(path), picture_(picture), corner_(kRulerWidth, kMargin),
          size_(picture.columns, static_cast<int>(picture.rows.size())),
          canvas_(corner_.x + size_.x + kMargin, corner_.y + size_.y + kMargin) {}

    void put_values(std::span<const float> values, const slice::Window& window) {
        canvas_.put_values(values, size_.x, corner_, window);
    }

    void put_walls(const Lumens& lumens, const std::optional<glm::vec3>& colour) {
        const auto walls = slice::walls_of(picture_, lumens);
        for (const slice::PathPart& part : path_.parts)
            for (slice::Outline& line : render::wall_lines_of(path_, part, picture_, walls))
                put_line(std::move(line), colour.value_or(label_colour(static_cast<std::size_t>(part.branch))));
    }

    void put_ruler(const Lengths& lengths) {
        for (const double arc : round_numbers(0.0, path_.length_mm())) {
            const int y = corner_.y + static_cast<int>(std::lround(slice::pixel_of(picture_, path_, arc).y));
            const std::vector<glm::dvec2> tick{{kRulerWidth - 9, y}, {kRulerWidth - 2, y}};
            canvas_.put_line(tick, kRulerColour, 1.0, {0, 0}, {kRulerWidth, corner_.y + size_.y + kMargin});
            canvas_.put_text(lengths.text(arc), {2, y - 9}, 8.0);
        }
    }

    [[nodiscard]] PaintedSlices finished(const slice::Window& window) const {
        return {canvas_.image(), corner_, size_, {1, 1}, 0, picture_.mm_per_pixel, window};
    }

private:
    void put_line(slice::Outline line, const glm::vec3& colour) {
        for (glm::dvec2& point : line) point += glm::dvec2(corner_);
        put_outline(canvas_, line, colour, corner_, corner_ + size_);
    }

    const slice::VesselPath& path_;
    const slice::Reformation& picture_;
    glm::ivec2 corner_, size_;
    SliceCanvas canvas_;
};

} // namespace

Result<PaintedSlices> painted_reformation(const volume::Volume& scan, const slice::VesselPath& path,
                                          const slice::Reformation& picture, const Outlines& outlines,
                                          const std::optional<slice::Window>& window, const Lengths& lengths) {
    if (auto fits = check_size(picture.columns, static_cast<double>(picture.rows.size())); !fits)
        return tl::unexpected(fits.error());
    const std::vector<float> values = slice::sampled(scan, picture);
    const slice::Window shown = window ? *window : slice::usual_window(scan);
    ReformationPainter painter(path, picture);
    painter.put_values(values, shown);
    if (!outlines.mask.empty()) painter.put_walls(outlines.mask, kMaskColour);
    painter.put_walls(outlines.surface, {});
    painter.put_ruler(lengths);
    return painter.finished(shown);
}

Result<PaintedSlices> painted_sections(const volume::Volume& scan, std::span<const slice::PathSample> samples,
                                       double width_mm, const Outlines& outlines,
                                       const std::optional<slice::Window>& window, const Lengths& lengths) {
    // Tuned: large enough for the captions, small enough for a sheet.
    constexpr double kFewest = 160.0, kMost = 320.0;
    const double mm = std::clamp(0.5 * slice::smallest_spacing_mm(scan), width_mm / kMost, width_mm / kFewest);
    const int side = static_cast<int>(std::lround(width_mm / mm));
    const int count = static_cast<int>(samples.size());
    const int across = std::max(1, static_cast<int>(std::ceil(std::sqrt(count * 4.0 / 3.0))));
    const int down = (count + across - 1) / across;
    const glm::ivec2 size = glm::ivec2(across, down) * (side + kGap) - kGap + 2 * kMargin;
    if (auto fits = check_size(size.x, size.y); !fits) return tl::unexpected(fits.error());
    std::vector<std::vector<float>> values;
    for (const slice::PathSample& sample : samples)
        values.push_back(slice::sampled(scan, slice::cross_grid(sample, mm, side)));
    const slice::Window shown = window ? *window : slice::usual_window(scan);
    SliceCanvas canvas(size.x, size.y);
    for (int n = 0; n < count; ++n) {
        const auto i = static_cast<std::size_t>(n);
        const glm::ivec2 corner = kMargin + glm::ivec2(n % across, n / across) * (side + kGap);
        canvas.put_values(values[i], side, corner, shown);
        const slice::PixelGrid grid = slice::cross_grid(samples[i], mm, side);
        const auto put_loops = [&](const Lumens& lumens, const glm::vec3& colour) {
            if (lumens.empty() || !lumens[i]) return;
            for (const slice::Loop& loop : lumens[i]->loops) {
                slice::Outline line;
                for (const slice::EdgePoint& point : loop.points)
                    line.push_back(grid.pixel(point.at) + glm::dvec2(corner));
                if (loop.closed) line.push_back(line.front());
                put_outline(canvas, line, colour, corner, corner + side);
            }
        };
        put_loops(outlines.mask, kMaskColour);
        put_loops(outlines.surface, label_colour(static_cast<std::size_t>(samples[i].place.branch)));
        canvas.put_text(lengths.text(samples[i].arc_mm), corner + 2);
    }
    return PaintedSlices{canvas.image(), glm::ivec2(kMargin), glm::ivec2(side), {across, down}, kGap, mm, shown};
}

} // namespace ramus::app
