// The scale bar: a round length, how many pixels it takes, and where in the picture that holds. In parallel projection
// it holds everywhere. In perspective what is twice as far away looks half as long, so a bar is of one depth and says
// of which: of what is under the pointer, of what the view turns about, or of the middle of what is visible. Of the
// middle it says by how much what is nearest and farthest differs from it, and where what is farthest is more than
// twice as far away as what is nearest (a share of more than a third) there is no bar: no length would hold.
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
    bool unit_known = true;      // that lengths are mm; else they are units
    int percent = 0;             // by which lengths elsewhere differ at most, rounded up; 0: not to speak of
    bool operator==(const ScaleBar&) const = default;
};

inline constexpr double kMostShare = 1.0 / 3.0;

// The scale of what lies at this point; none where it is not before the eye, and in parallel projection.
[[nodiscard]] std::optional<Scale> scale_at(const Camera& camera, glm::ivec2 size, const glm::dvec3& point,
                                            Scale::At at);
// At the middle of what is visible; none where it is too deep for one length.
[[nodiscard]] std::optional<Scale> scale_of(const Camera& camera, glm::ivec2 size, const Visible& visible);

// "pointer", "pivot", "middle"; "everywhere" where there is none.
[[nodiscard]] std::string_view name_of_place(std::optional<Scale::At> at);

// Of at most so many pixels. None in perspective without a scale.
[[nodiscard]] std::optional<ScaleBar> scale_bar_of(const Camera& camera, glm::ivec2 size,
                                                   const std::optional<Scale>& scale, double most_pixels);

// A length of 1, 2 or 5 times a power of ten, at most `longest_mm`.
[[nodiscard]] double scale_bar_length_mm(double longest_mm);
// "500 um" (with the micro sign in Latin-1), "20 mm", "20 cm"; "20 units" where nobody has said what a unit is.
[[nodiscard]] std::string scale_bar_label(double length_mm, bool unit_known = true);
// "at the middle, +-18 %" (with the sign in Latin-1); empty where it holds everywhere.
[[nodiscard]] std::string place_of(const ScaleBar& bar);

[[nodiscard]] Image paint_scale_bar(const ScaleBar& bar, double pixel_ratio);

} // namespace ramus::render
