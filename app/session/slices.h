// SliceViews: how the scans of a session are looked at: layout, crosshair, zoom and what is drawn on slices. Part of a
// session like its camera: saved, but not covered by undo. A plain value.
#pragma once

#include "app/session/along_vessel.h"
#include "core/slice/pixel_grid.h"
#include "core/slice/sample.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

// What the picture is divided into.
enum class SliceLayout : std::uint8_t {
    kPicture, // the tree alone
    kSlices,  // the tree and three slices, 2 x 2
    kLarge,   // the tree large, three slices at its right
    kAxial,   // one slice alone
    kCoronal,
    kSagittal,
    kOblique,
    kAlong, // the tree, the section across a vessel, and the picture along the vessel
};
inline constexpr std::array<std::pair<SliceLayout, std::string_view>, 8> kSliceLayouts{
    {{SliceLayout::kPicture, "picture"},
     {SliceLayout::kSlices, "slices"},
     {SliceLayout::kLarge, "large"},
     {SliceLayout::kAxial, "axial"},
     {SliceLayout::kCoronal, "coronal"},
     {SliceLayout::kSagittal, "sagittal"},
     {SliceLayout::kOblique, "oblique"},
     {SliceLayout::kAlong, "along"}}};
[[nodiscard]] std::string_view name_of(SliceLayout layout);
[[nodiscard]] std::optional<SliceLayout> layout_named(std::string_view name);
// The slices that a layout has, in the order of its parts.
[[nodiscard]] std::vector<slice::Direction> slices_of(SliceLayout layout);
[[nodiscard]] bool has_tree(SliceLayout layout); // whether it has a part for the tree

inline constexpr double kMostSlabMm = 1000.0;

// The part of a slice that is seen.
struct SliceZoom {
    double factor = 1.0;   // 1: all of the scan fits
    glm::dvec2 shift{0.0}; // mm along the picture's right and down from the scan's middle to the picture's
    bool operator==(const SliceZoom&) const = default;
};

struct SliceViews {
    SliceLayout layout = SliceLayout::kPicture;
    std::optional<glm::dvec3> crosshair;      // mm, RAS; none: the middle of the scan
    glm::dvec3 oblique_normal{0.0, 0.0, 1.0}; // of the oblique slice, of unit length
    std::optional<glm::dvec3> oblique_right; // its pictures' right; none, or not at right angles: that of axes_across()
    std::optional<AlongVessel> along;        // the vessel that the oblique slice follows
    std::array<SliceZoom, 4> zooms;          // by slice::Direction
    std::array<bool, 4> in_picture{};        // by slice::Direction: drawn as a plane among the vessels
    std::optional<slice::Direction> cut_away; // what lies before this slice is not drawn
    bool cut_behind = false;                  // instead: what lies behind it
    slice::Sampling sampling;
    bool outlines = true, axes = true; // of vessels
    bool crosshair_lines = true;

    [[nodiscard]] bool any_in_picture() const;
    bool operator==(const SliceViews&) const = default;
};

[[nodiscard]] inline std::size_t slice_index(slice::Direction direction) { return static_cast<std::size_t>(direction); }

// The axes of a slice.
[[nodiscard]] slice::Axes axes_of(const SliceViews& views, slice::Direction direction);

// sRGB. The customary colours of slices: axial red, coronal green, sagittal yellow; oblique violet.
[[nodiscard]] glm::vec3 slice_colour(slice::Direction direction);

} // namespace ramus::app
