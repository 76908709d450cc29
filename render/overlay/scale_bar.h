// The scale bar: a round length, its number of pixels, and where in the picture it holds. In parallel projection it
// holds everywhere. In perspective it holds at one depth, which the label names: at the pointer, at the pivot of the
// view, or at the visible middle. For the middle the label adds by how many percent lengths at the nearest and farthest
// visible points differ. If these differ by more than kMostShare (the farthest is more than twice as far away as the
// nearest), there is no bar.
#pragma once

#include "render/image/image.h"
#include "render/scene/depth_map.h"
#include "render/scene/frame.h"

#include <optional>
#include <string>
#include <string_view>

namespace ramus::render {

struct ScaleBar {
    double length_mm = 0.0, pixels = 0.0;
    std::optional<Scale::At> at; // none: everywhere
    bool unit_known = true;      // false: lengths are in unknown units instead of mm
    int percent = 0;             // largest difference of lengths elsewhere, rounded up; 0: negligible
    bool operator==(const ScaleBar&) const = default;
};

inline constexpr double kMostShare = 1.0 / 3.0;

// The scale at a point; none if the point is not in front of the eye, and in parallel projection.
[[nodiscard]] std::optional<Scale> scale_at(const Camera& camera, glm::ivec2 size, const glm::dvec3& point,
                                            Scale::At at);
// The scale at the visible middle; none if the visible part is too deep for one length.
[[nodiscard]] std::optional<Scale> scale_of(const Camera& camera, glm::ivec2 size, const Visible& visible);

// "pointer", "pivot", "middle"; "everywhere" for none.
[[nodiscard]] std::string_view name_of_place(std::optional<Scale::At> at);

// A bar of at most `most_pixels`. None in perspective without a scale.
[[nodiscard]] std::optional<ScaleBar> scale_bar_of(const Camera& camera, glm::ivec2 size,
                                                   const std::optional<Scale>& scale, double most_pixels);

// A length of 1, 2 or 5 times a power of ten, at most `longest_mm`.
[[nodiscard]] double scale_bar_length_mm(double longest_mm);
// "500 um" (with the micro sign in Latin-1), "20 mm", "20 cm"; "20 units" if the unit is unknown.
[[nodiscard]] std::string scale_bar_label(double length_mm, bool unit_known = true);
// "at the middle, +-18 %" (with the sign in Latin-1); empty if the bar holds everywhere.
[[nodiscard]] std::string place_of(const ScaleBar& bar);

[[nodiscard]] Image paint_scale_bar(const ScaleBar& bar, double pixel_ratio);

} // namespace ramus::render
