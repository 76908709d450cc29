// Plate: a small dark sheet with letters and patches of colour on it, for legends and labels. Straight alpha, sRGB;
// painted without GL.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"

#include <glm/vec3.hpp>
#include <string>

namespace ramus::render {

class Plate {
public:
    // Round corners of `radius` pixels; `opacity` 0 to 1.
    Plate(int width, int height, double radius, double opacity);

    // The part of the plate from `left`, `top`, in pixels and shares of them.
    void fill(double left, double top, double width, double height, const glm::vec3& srgb);
    void write(const Coverage& text, int left, int top, const glm::vec3& srgb);
    [[nodiscard]] Image take() && { return std::move(image_); }

private:
    void lay(int x, int y, const glm::vec3& srgb, double share);
    Image image_;
};

inline constexpr glm::vec3 kPlateInk{0.89F, 0.90F, 0.92F};
inline constexpr glm::vec3 kQuietInk{0.66F, 0.68F, 0.72F};

// One line of text on a plate.
[[nodiscard]] Image paint_label(const std::string& text, double pixel_ratio, const Font& font);

} // namespace ramus::render
