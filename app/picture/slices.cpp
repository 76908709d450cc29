#include "app/picture/slices.h"

#include "app/assets/assets.h"
#include "app/picture/along_picture.h"
#include "app/picture/colouring.h"
#include "app/picture/slice_marks.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/slice/sample.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>

namespace ramus::app {

namespace {

// The first visible scan that has been read; segmentations only if there is no other.
std::shared_ptr<const ScanFile> first_scan(const Marks& marks, const Assets& assets) {
    std::shared_ptr<const ScanFile> found;
    for (const Scan& scan : marks.scans) {
        if (!scan.visible || (found && scan.labels)) continue;
        auto file = assets.scan(scan);
        if (!file) continue;
        if (!scan.labels) return file;
        found = file;
    }
    return found;
}

// What slices show at a zoom of 1.
Bounds<glm::dvec3> bounds_of(const Session& session, const Assets& assets) {
    if (const auto scan = first_scan(session.marks, assets)) return slice::bounds_of(*scan->volume);
    Bounds<glm::dvec3> bounds;
    if (assets.tree) {
        const render::Box box = render::bounds_of(*assets.tree);
        if (!box.empty()) bounds = {glm::dvec3(box.lower), glm::dvec3(box.upper)};
    } else if (const render::Box box = assets.box_of(session.marks.context); !box.empty()) {
        bounds = {glm::dvec3(box.lower), glm::dvec3(box.upper)};
    }
    return bounds.is_empty() ? Bounds<glm::dvec3>{glm::dvec3(-1.0), glm::dvec3(1.0)} : bounds;
}

glm::vec3 colour_of_label(const volume::Volume& mask, const Scan& scan, std::size_t index, std::int32_t label,
                          std::size_t count) {
    const volume::LabelName* name = volume::name_of_label(mask, label);
    if (name != nullptr && name->colour) return srgb_of(*name->colour);
    if (count == 1) return srgb_of(scan.colour);
    return label_colour(index);
}

render::MaskLayer mask_layer(const Scan& scan, const ScanFile& file) {
    constexpr double kFill = 0.35; // of the opacity: the scan must be seen through it
    render::MaskLayer layer{
        file.volume, {}, static_cast<float>(kFill * scan.opacity), static_cast<float>(scan.opacity)};
    for (std::size_t n = 0; n < file.labels.size(); ++n)
        layer.labels.push_back(
            {file.labels[n], colour_of_label(*file.volume, scan, n, file.labels[n], file.labels.size())});
    // A mask of fractions has no labels.
    if (layer.labels.empty()) layer.labels.push_back({1, colour_of_label(*file.volume, scan, 0, 1, 1)});
    return layer;
}

// The region that is grown, as it was grown last.
void add_region(render::SliceView& view, const Marks& marks, const ScanRegion& region) {
    if (!region.exists() || !region.grown.shown || region.grown.of.scan != region.now().scan) return;
    const auto is_shown = [&](const Scan& scan) { return scan.visible && source_of(scan) == region.now().scan; };
    if (std::ranges::none_of(marks.scans, is_shown)) return;
    constexpr float kFill = 0.3F; // the scan must be seen through it
    view.masks.push_back({region.grown.shown, {{1, srgb_of(kRegionColour)}}, kFill, 0.95F});
}

// The colours of the slices that cross a slice along its rows and along its columns.
std::pair<slice::Direction, slice::Direction> crossing(slice::Direction direction) {
    using enum slice::Direction;
    switch (direction) {
    case kCoronal:
        return {kAxial, kSagittal};
    case kSagittal:
        return {kAxial, kCoronal};
    case kAxial:
    case kOblique:
        break;
    }
    return {kCoronal, kSagittal};
}

} // namespace

glm::dvec3 crosshair_of(const Session& session, const Assets& assets) {
    if (session.slices.crosshair) return *session.slices.crosshair;
    if (const auto scan = first_scan(session.marks, assets)) return slice::middle_of(*scan->volume);
    const Bounds<glm::dvec3> bounds = bounds_of(session, assets);
    return 0.5 * (bounds.least + bounds.most);
}

slice::Plane plane_of(const Session& session, const Assets& assets, slice::Direction direction) {
    return {crosshair_of(session, assets), axes_of(session.slices, direction).to_viewer()};
}

slice::PixelGrid grid_of(const Session& session, const Assets& assets, slice::Direction direction, glm::ivec2 size) {
    return zoomed_grid(session, assets, direction, size, session.slices.zooms[slice_index(direction)]);
}

namespace {

// In the layout along a vessel, the slice across it stays around the vessel, and is as wide as the picture along it.
slice::PixelGrid grid_across(const Session& session, const Assets& assets, glm::ivec2 size, const SliceZoom& zoom) {
    const slice::Axes axes = axes_of(session.slices, slice::Direction::kOblique);
    const AlongVessel& along = *session.slices.along;
    const slice::VesselPath& path = *assets.followed.path;
    const double mm_per_pixel =
        along.width_mm.value_or(usual_width_mm(path)) / std::max(1, std::min(size.x, size.y)) / zoom.factor;
    const glm::dvec3 place = path.at(along.at_mm).at;
    const glm::dvec3 normal = axes.to_viewer();
    const glm::dvec3 on_plane = place + glm::dot(crosshair_of(session, assets) - place, normal) * normal;
    return slice::grid_around(axes, on_plane + zoom.shift.x * axes.right + zoom.shift.y * axes.down, mm_per_pixel,
                              size);
}

} // namespace

slice::PixelGrid zoomed_grid(const Session& session, const Assets& assets, slice::Direction direction, glm::ivec2 size,
                             const SliceZoom& zoom) {
    const bool follows = session.slices.layout == SliceLayout::kAlong && session.slices.along && assets.followed.path;
    if (follows && direction == slice::Direction::kOblique) return grid_across(session, assets, size, zoom);
    const slice::Axes axes = axes_of(session.slices, direction);
    const Bounds<glm::dvec3> bounds = bounds_of(session, assets);
    const glm::dvec3 middle = 0.5 * (bounds.least + bounds.most);
    const glm::dvec3 half = 0.5 * bounds.size();
    const double across = 2.0 * glm::dot(glm::abs(axes.right), half);
    const double high = 2.0 * glm::dot(glm::abs(axes.down), half);
    double whole = std::max(across / size.x, high / size.y); // mm in a pixel at a zoom of 1
    // A straight vessel along the view has no width here.
    if (!(whole > 0.0)) whole = std::max(glm::length(bounds.size()), 1.0) / std::min(size.x, size.y);
    const double mm_per_pixel = whole / zoom.factor;
    const glm::dvec3 normal = axes.to_viewer();
    const glm::dvec3 at = crosshair_of(session, assets);
    const glm::dvec3 on_plane = middle + glm::dot(at - middle, normal) * normal;
    return slice::grid_around(axes, on_plane + zoom.shift.x * axes.right + zoom.shift.y * axes.down, mm_per_pixel,
                              size);
}

double step_mm(const Session& session, const Assets& assets, slice::Direction direction) {
    const auto scan = first_scan(session.marks, assets);
    if (!scan) return 1.0;
    if (direction == slice::Direction::kOblique) return slice::smallest_spacing_mm(*scan->volume);
    const glm::dvec3 normal = axes_of(session.slices, direction).to_viewer();
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        most = std::max(most, std::abs(glm::dot(glm::dvec3(scan->volume->to_patient[axis]), normal)));
    return most;
}

std::shared_ptr<const volume::Volume> first_volume(const Session& session, const Assets& assets) {
    const auto scan = first_scan(session.marks, assets);
    return scan ? scan->volume : nullptr;
}

slice::Window window_of(const Scan& scan, const ScanFile& file) { return scan.window.value_or(file.window); }

std::optional<slice::Window> window_in(const std::string& word) {
    if (const auto named = slice::window_named(word)) return named;
    const auto comma = word.find(',');
    if (comma == std::string::npos) return {};
    const auto width = parsed<double>(word.substr(0, comma));
    const auto level = parsed<double>(word.substr(comma + 1));
    constexpr double kMost = 1e12;
    if (!width || !level || !(*width > 0.0 && *width <= kMost) || !(std::abs(*level) <= kMost)) return {};
    return slice::Window{*level, *width};
}

std::string words_of_scan(const ScanFile& file, const Lengths& lengths) {
    const volume::Volume& volume = *file.volume;
    const glm::dvec3 spacing = volume::spacing_mm(volume.to_patient);
    return std::to_string(volume.size.x) + " x " + std::to_string(volume.size.y) + " x " +
           std::to_string(volume.size.z) + " voxels of " + digits(spacing.x) + " x " + digits(spacing.y) + " x " +
           lengths.text(spacing.z);
}

tree::Claims slice_claims(const Session& session, const Assets& assets) {
    const tree::Claims claims = assets.claims_of(session.marks);
    return assets.tree ? claims.with(assets.tree->claims) : claims;
}

namespace {

// "S 12.3": a coordinate to a tenth of a mm, however far from the origin.
std::string coordinate_words(const glm::dvec3& place, int axis, const tree::Claims& claims) {
    constexpr std::array<std::string_view, 6> kSides{"R ", "L ", "A ", "P ", "S ", "I "};
    constexpr std::array<std::string_view, 3> kAxes{"x ", "y ", "z "};
    const double at = place[axis];
    const bool sides = claims.has_sides();
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.1f", sides ? std::abs(at) : at);
    const auto side = static_cast<std::size_t>(2 * axis + (at < 0.0 ? 1 : 0));
    return std::string(sides ? kSides[side] : kAxes[static_cast<std::size_t>(axis)]) + number.data();
}

} // namespace

std::string place_words(const glm::dvec3& place, const tree::Claims& claims) {
    return coordinate_words(place, 0, claims) + ", " + coordinate_words(place, 1, claims) + ", " +
           coordinate_words(place, 2, claims) + " " + Lengths(claims).unit();
}

std::string value_words(const glm::dvec3& place, const Session& session, const Assets& assets) {
    std::string words;
    for (const Scan& scan : session.marks.scans) {
        const auto file = scan.visible ? assets.scan(scan) : nullptr;
        if (!file) continue;
        const volume::Volume& volume = *file->volume;
        const float value = slice::value_at(volume, place);
        if (std::isnan(value)) continue;
        const volume::LabelName* name =
            scan.labels ? volume::name_of_label(volume, static_cast<std::int32_t>(value)) : nullptr;
        if (scan.labels && value == 0.0F) continue;
        words += words.empty() ? "" : "   ";
        if (scan.labels)
            words += name != nullptr && !name->name.empty() ? name->name : "label " + rounded(double{value});
        else
            words += rounded(double{value}) + (volume.value_unit.empty() ? "" : " " + volume.value_unit);
    }
    return words;
}

std::string caption_of(slice::Direction direction, const slice::Plane& plane, const slice::Sampling& sampling,
                       const tree::Claims& claims) {
    const Lengths lengths(claims);
    std::string caption(slice::name_of(direction));
    caption.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(caption.front())));
    const auto at = [&](int axis) { return coordinate_words(plane.point, axis, claims) + " " + lengths.unit(); };
    switch (direction) {
    case slice::Direction::kAxial:
        caption += ", " + at(2);
        break;
    case slice::Direction::kCoronal:
        caption += ", " + at(1);
        break;
    case slice::Direction::kSagittal:
        caption += ", " + at(0);
        break;
    case slice::Direction::kOblique:
        caption += ", " + place_words(plane.point, claims);
        break;
    }
    if (sampling.slab_mm > 0.0)
        caption += ", " + std::string(slice::name_of(sampling.slab)) + " of " + lengths.text(sampling.slab_mm);
    return caption;
}

render::Camera camera_of_planes(std::span<const glm::vec3> points, glm::ivec2 size) {
    constexpr double kPlanesAzimuth = 35.0;
    constexpr double kPlanesElevation = 25.0; // degrees
    const render::Camera front = render::camera_for(points, render::View::kAnterior, size);
    return render::fitted(render::turned(front, kPlanesAzimuth, kPlanesElevation), points, size);
}

void add_scans(render::SliceView& view, const Session& session, const Assets& assets) {
    for (const Scan& scan : session.marks.scans) {
        const auto file = scan.visible && scan.opacity > 0.0 ? assets.scan(scan) : nullptr;
        if (!file) continue;
        if (scan.labels)
            view.masks.push_back(mask_layer(scan, *file));
        else
            view.scans.push_back({file->volume, window_of(scan, *file), static_cast<float>(scan.opacity)});
    }
    add_region(view, session.marks, assets.region);
}

render::SliceView compose_slice(const Session& session, const Assets& assets, slice::Direction direction,
                                const Viewing& viewing) {
    render::SliceView view;
    view.grid = grid_of(session, assets, direction, viewing.size);
    view.sampling = session.slices.sampling;
    view.outlines = session.slices.outlines;
    view.axes = session.slices.axes;
    view.pixel_ratio = viewing.pixel_ratio;
    add_scans(view, session, assets);
    const glm::dvec3 at = crosshair_of(session, assets);
    if (session.slices.crosshair_lines) {
        const auto [row, column] = crossing(direction);
        view.crosshair = render::Crosshair{at, slice_colour(row), slice_colour(column)};
    }
    const tree::Claims claims = slice_claims(session, assets);
    render::Overlays& overlays = view.overlays;
    overlays.orientation_cube = false;
    overlays.orientation_letters = true;
    overlays.axes = claims.has_sides() ? render::side_letters() : render::plain_axes();
    overlays.unit_known = claims.has_unit();
    overlays.caption = latin1(caption_of(direction, {at, {}}, view.sampling, claims));
    draw_marks(view, session, assets, direction, viewing);
    return view;
}

} // namespace ramus::app
