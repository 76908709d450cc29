// Text on a picture: the caption and the orientation letters at its edges. Painted without GL.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/camera.h"

#include <glm/vec3.hpp>
#include <string>

namespace ramus::render {

// Light ink with a dark halo of `halo` pixels, readable over vessels and any background.
[[nodiscard]] Image haloed(const Coverage& ink, int halo);

// Swaps the ink and the halo: dark ink in a light halo, or back.
[[nodiscard]] Image with_dark_ink(Image haloed);

// The anatomical name of a direction (RAS), its largest component first: "L", "LA", "SAL". Components below about 20
// degrees are omitted.
[[nodiscard]] std::string orientation_letters(const glm::dvec3& direction, const AxisNames& axes = side_letters());

// Latin-1 text, wrapped at words to `width` pixels where possible.
[[nodiscard]] Image paint_caption(const std::string& text, double pixel_ratio, int width);

} // namespace ramus::render
