// Words on a picture: a caption, and the letters of radiology at its edges. Painted without GL.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/scene/camera.h"

#include <glm/vec3.hpp>
#include <string>

namespace ramus::render {

// Light ink with a dark halo of so many pixels: it reads over vessels and over any background.
[[nodiscard]] Image haloed(const Coverage& ink, int halo);

// The same with dark ink in a light halo, or back.
[[nodiscard]] Image with_dark_ink(Image haloed);

// Which way of the patient a direction (RAS) goes, the most first: "L", "LA", "SAL". A part below about 20 degrees has
// no letter.
[[nodiscard]] std::string orientation_letters(const glm::dvec3& direction, const AxisNames& axes = side_letters());

// Latin-1, in lines of at most so many pixels where words allow it.
[[nodiscard]] Image paint_caption(const std::string& text, double pixel_ratio, int width);

} // namespace ramus::render
