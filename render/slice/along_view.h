// AlongView: a picture of the scan along a vessel (core/slice/reformation.h) as a part of a SliceView: everything that
// determines it in addition to the scans. The vessel goes from the top to the bottom, with distances at the left. A
// plain comparable value; large parts are shared. Units: mm, degrees; pixels are those of the SliceView.
#pragma once

#include "core/slice/cross_section.h"
#include "core/slice/reformation.h"
#include "core/slice/vessel_path.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::render {

struct AlongView {
    // A part of the way, in any order; a place if both are equal.
    using Stretch = std::pair<double, double>;

    std::shared_ptr<const slice::VesselPath> path; // null: only what is written over the picture is drawn
    // Of the frame's mesh at the samples of the path, for the walls; null: not measured yet, no walls.
    std::shared_ptr<const std::vector<std::optional<slice::Lumen>>> lumens{};
    slice::ReformationKind kind = slice::ReformationKind::kStraightened;
    double angle_deg = 0.0, width_mm = 1.0;
    double scale = 1.0;                                  // pixels for a pixel of the reformation
    glm::dvec2 corner{0.0};                              // where the upper left corner of the reformation is
    double at_mm = 0.0;                                  // the current place
    std::optional<Stretch> narrow{}, reference{};        // of a stenosis
    std::vector<std::pair<double, std::string>> ticks{}; // distances and their words, Latin-1
    bool operator==(const AlongView&) const = default;

    // The picture, for a path.
    [[nodiscard]] slice::Reformation reformation() const {
        return slice::reformation_along(*path, kind, angle_deg, width_mm);
    }
    // From the column and row of the reformation to a pixel, and back; both count from the middle of the first pixel.
    [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& cell) const { return corner + scale * (cell + 0.5) - 0.5; }
    [[nodiscard]] glm::dvec2 cell(const glm::dvec2& pixel) const { return (pixel + 0.5 - corner) / scale - 0.5; }
    // What a pixel shows; pixels beyond the picture count as those at its edge. None without a path.
    [[nodiscard]] std::optional<slice::PicturePlace> place_at(const glm::dvec2& pixel) const {
        if (!path) return {};
        const slice::Reformation picture = reformation();
        const glm::dvec2 most(picture.columns - 1.0, static_cast<double>(picture.rows.size()) - 1.0);
        return slice::place_of(picture, glm::clamp(cell(pixel), glm::dvec2(0.0), most));
    }
};

} // namespace ramus::render
