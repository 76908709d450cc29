#include "render/slice/along_painter.h"

#include "core/base/bounds.h"
#include "core/mesh/line_box.h"
#include "render/image/canvas.h"
#include "render/image/text.h"
#include "render/overlay/captions.h"
#include "render/slice/branch_ink.h"
#include "render/slice/frame_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::render {

namespace {

constexpr glm::vec3 kAlongInk{0.85F}, kPlaceInk{0.72F, 0.56F, 0.98F}; // violet: that of the oblique slice
constexpr glm::vec3 kNarrowInk{0.95F, 0.94F, 0.40F}, kReferenceInk{0.52F, 0.72F, 1.00F};

// What determines the reformation.
AlongView geometry_of(const AlongView& along) {
    AlongView geometry;
    geometry.path = along.path;
    geometry.kind = along.kind;
    geometry.angle_deg = along.angle_deg;
    geometry.width_mm = along.width_mm;
    return geometry;
}

// The value at a cell between cells, NaN next to cells without a value.
float value_between(const std::vector<float>& values, int columns, int rows, const glm::dvec2& cell) {
    const double x = std::clamp(cell.x, 0.0, columns - 1.0);
    const double y = std::clamp(cell.y, 0.0, rows - 1.0);
    const int left = std::min(static_cast<int>(x), std::max(columns - 2, 0));
    const int top = std::min(static_cast<int>(y), std::max(rows - 2, 0));
    const auto at = [&](int column, int row) {
        return values[static_cast<std::size_t>(std::min(row, rows - 1)) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(std::min(column, columns - 1))];
    };
    const auto right = static_cast<float>(x - left);
    const auto down = static_cast<float>(y - top);
    const float above = (1.0F - right) * at(left, top) + right * at(left + 1, top);
    const float below = (1.0F - right) * at(left, top + 1) + right * at(left + 1, top + 1);
    return (1.0F - down) * above + down * below;
}

float nearest_value(const std::vector<float>& values, int columns, int rows, const glm::dvec2& cell) {
    const int column = std::clamp(static_cast<int>(std::lround(cell.x)), 0, columns - 1);
    const int row = std::clamp(static_cast<int>(std::lround(cell.y)), 0, rows - 1);
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
}

// The pixels of a reformation in a picture.
struct CoveredPixels {
    glm::ivec2 low, high; // the latter not included
};
CoveredPixels covered_pixels(const AlongView& along, const slice::Reformation& picture, const Image& image) {
    const glm::dvec2 cells(picture.columns, static_cast<double>(picture.rows.size()));
    const glm::ivec2 whole(image.width, image.height);
    const glm::ivec2 low = glm::clamp(glm::ivec2(glm::round(along.corner)), glm::ivec2(0), whole);
    const glm::ivec2 high = glm::clamp(glm::ivec2(glm::round(along.corner + along.scale * cells)), low, whole);
    return {low, high};
}

void paint_words(const std::string& words, const glm::dvec2& right_middle, float ratio, Image& image) {
    constexpr int kHalo = 1;
    const Coverage ink = draw_text(words, 7.5 * static_cast<double>(ratio));
    Coverage padded(ink.width + 2 * kHalo, ink.height + 2 * kHalo);
    padded.put(kHalo, kHalo, ink);
    Canvas(image).picture(haloed(padded, kHalo),
                          glm::ivec2(glm::round(right_middle - glm::dvec2(padded.width, 0.5 * padded.height))));
}

// A ruler at the left of the picture, with its stretches.
void paint_ruler(const AlongView& along, const slice::Reformation& picture, float ratio, Image& image) {
    Canvas canvas(image);
    const double points = ratio;
    const double x = along.corner.x - 4.0 * points;
    const auto row_of = [&](double arc_mm) { return along.pixel(slice::pixel_of(picture, *along.path, arc_mm)).y; };
    const auto bar = [&](const std::optional<AlongView::Stretch>& stretch, const glm::vec3& colour) {
        if (!stretch) return;
        const std::array ends{glm::dvec2(x, row_of(stretch->first)), glm::dvec2(x, row_of(stretch->second))};
        canvas.line(ends, false, {colour, 4.0F * ratio, 1.0F});
    };
    bar(along.narrow, kNarrowInk);
    bar(along.reference, kReferenceInk);
    for (const auto& [arc, words] : along.ticks) {
        const double y = row_of(arc);
        const std::array ends{glm::dvec2(x - 5.0 * points, y), glm::dvec2(x, y)};
        canvas.line(ends, false, {kAlongInk, 1.0F * ratio, 1.0F});
        paint_words(words, {x - 6.0 * points, y}, ratio, image);
    }
}

// The current place: a line across the picture with a gap at the axis.
void paint_place(const AlongView& along, const slice::Reformation& picture, float ratio, Image& image) {
    Canvas canvas(image);
    const glm::dvec2 at = along.pixel(slice::pixel_of(picture, *along.path, along.at_mm));
    const double left = along.corner.x - 4.0 * static_cast<double>(ratio);
    const double right = along.corner.x + along.scale * picture.columns;
    const double gap = 7.0 * static_cast<double>(ratio);
    const std::array first{glm::dvec2(left, at.y), glm::dvec2(std::max(left, at.x - gap), at.y)};
    const std::array second{glm::dvec2(std::min(right, at.x + gap), at.y), glm::dvec2(right, at.y)};
    for (const auto& ends : {first, second}) {
        canvas.line(ends, false, {glm::vec3(0.0F), 3.0F * ratio, 0.4F});
        canvas.line(ends, false, {kPlaceInk, 1.4F * ratio, 1.0F});
    }
}

} // namespace

std::vector<slice::Outline> wall_lines_of(const slice::VesselPath& path, const slice::PathPart& part,
                                          const slice::Reformation& picture, slice::Walls walls) {
    const double slack = picture.mm_per_pixel; // parts share a row, so that lines touch
    for (std::size_t row = 0; row < walls.size(); ++row)
        if (picture.rows[row].arc_mm < part.begin_mm - slack || picture.rows[row].arc_mm > part.end_mm)
            walls[row].reset();
    double widest = 0.0;
    for (const slice::PathSample& sample : path.samples) widest = std::max(widest, sample.radius_mm);
    return slice::wall_lines(walls, std::max(4.0, 0.5 * widest / picture.mm_per_pixel));
}

std::vector<char> branches_around(const std::vector<std::optional<slice::Lumen>>& lumens, const PagedMesh& mesh) {
    std::vector<char> branches(static_cast<std::size_t>(mesh.branch_count()));
    for (const auto& lumen : lumens) {
        if (!lumen || lumen->loops.empty()) continue;
        for (const slice::EdgePoint& point : lumen->loops.front().points)
            branches[static_cast<std::size_t>(branch_at(mesh, point))] = 1;
    }
    return branches;
}

slice::Walls walls_of(const slice::Reformation& picture, const PagedMesh& mesh, const std::vector<char>& branches) {
    const auto place = [&](std::uint32_t vertex) { return mesh.origin() + glm::dvec3(mesh.vertex(vertex).position); };
    const auto counts = [&](std::int32_t branch) { return branches[static_cast<std::size_t>(branch)] != 0; };
    return slice::walls_of(picture, [&](const slice::RowLine& line, std::vector<slice::CutTriangle>& pieces) {
        for (const auto& page : mesh.triangle_pages()) {
            if (!page || page->count == 0) continue;
            const Bounds<glm::dvec3> box{mesh.origin() + glm::dvec3(page->lower),
                                         mesh.origin() + glm::dvec3(page->upper)};
            if (!mesh::line_meets_box(line.from, line.to, box)) continue;
            for (const TrianglePage::Run& run : page->runs)
                if (counts(run.branch))
                    slice::cut_triangles(page->triangles.subspan(run.first, run.count), line.plane, place, pieces);
            for (std::uint32_t t = page->first_border; t < page->count; ++t)
                if (counts(mesh.vertex(page->triangles[t].x).branch))
                    slice::cut_triangles(page->triangles.subspan(t, 1), line.plane, place, pieces);
        }
    });
}

void AlongPainter::follow(const AlongView& along) {
    AlongView geometry = geometry_of(along);
    if (picture_ && of_ == geometry) return;
    picture_ = along.reformation();
    of_ = std::move(geometry);
    sampled_.clear();
    walls_.reset();
}

void AlongPainter::paint_scans(const SliceView& view, Image& image) {
    if (sampled_by_ != view.sampling) sampled_.clear();
    sampled_by_ = view.sampling;
    sampled_.take(view.scans,
                  [&](const volume::Volume& scan) { return slice::sampled(scan, *picture_, view.sampling); });
    const AlongView& along = *view.along;
    const CoveredPixels covered = covered_pixels(along, *picture_, image);
    const bool nearest = view.sampling.interpolation == slice::Interpolation::kNearest;
    const int columns = picture_->columns;
    const int rows = static_cast<int>(picture_->rows.size());
    tbb::parallel_for(covered.low.y, covered.high.y, [&](int y) {
        for (int x = covered.low.x; x < covered.high.x; ++x) {
            const glm::dvec2 cell = along.cell({x, y});
            for (std::size_t layer = 0; layer < sampled_.all().size(); ++layer) {
                const std::vector<float>& values = sampled_.all()[layer].values;
                const float value =
                    nearest ? nearest_value(values, columns, rows, cell) : value_between(values, columns, rows, cell);
                if (std::isnan(value)) continue;
                const float grey = view.scans[layer].window.grey(value);
                const float opacity = view.scans[layer].opacity;
                std::uint8_t* const out = image.pixel(x, y);
                for (int k = 0; k < 3; ++k)
                    out[k] = static_cast<std::uint8_t>(
                        std::lround((1.0F - opacity) * static_cast<float>(out[k]) + 255.0F * opacity * grey));
            }
        }
    });
}

void AlongPainter::paint_walls(const Frame& frame, const SliceView& view, Image& image) {
    const AlongView& along = *view.along;
    const bool straightened = along.kind == slice::ReformationKind::kStraightened;
    if (!along.lumens || !frame.mesh) return;
    if (!walls_ || walls_of_ != along.lumens) {
        walls_ = straightened ? slice::walls_of(*picture_, *along.lumens)
                              : walls_of(*picture_, *frame.mesh, branches_around(*along.lumens, *frame.mesh));
        walls_of_ = along.lumens;
    }
    const BranchInk inks(frame);
    const CoveredPixels covered = covered_pixels(along, *picture_, image);
    Canvas canvas(image, covered.low, covered.high);
    for (const slice::PathPart& part : along.path->parts) {
        const glm::dvec3 middle = along.path->at(0.5 * (part.begin_mm + part.end_mm)).at;
        const auto ink = inks.at(part.branch, middle, {});
        if (!ink) continue;
        for (const slice::Outline& line : wall_lines_of(*along.path, part, *picture_, *walls_)) {
            slice::Outline pixels;
            pixels.reserve(line.size());
            for (const glm::dvec2& cell : line) pixels.push_back(along.pixel(cell));
            canvas.line(pixels, false, {ink->colour, ink->width * view.pixel_ratio, ink->opacity});
        }
    }
}

void AlongPainter::paint(const Frame& frame, const SliceView& view, Image& image) {
    const AlongView& along = *view.along;
    if (!along.path) return;
    follow(along);
    paint_scans(view, image);
    if (view.outlines) paint_walls(frame, view, image);
    paint_ruler(along, *picture_, view.pixel_ratio, image);
    paint_place(along, *picture_, view.pixel_ratio, image);
}

} // namespace ramus::render
