#include "core/io/volumes/dicom/dicom_lab.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace ramus::io {

std::array<std::uint8_t, 3> srgb_of_dicom_lab(const std::array<int, 3>& lab) {
    const double lightness = lab[0] * 100.0 / 65535.0;
    const double a = lab[1] * 255.0 / 65535.0 - 128.0, b = lab[2] * 255.0 / 65535.0 - 128.0;
    const auto uncurved = [](double f) { return f > 6.0 / 29.0 ? f * f * f : (f - 4.0 / 29.0) * 108.0 / 841.0; };
    const double fy = (lightness + 16.0) / 116.0;
    constexpr glm::dvec3 kD50(0.96422, 1.0, 0.82521);
    const glm::dvec3 xyz = kD50 * glm::dvec3(uncurved(fy + a / 500.0), uncurved(fy), uncurved(fy - b / 200.0));
    // From D50 to linear sRGB, adapted to its D65 by Bradford's method (B. Lindbloom's table); columns.
    constexpr glm::dmat3 kToLinear(3.1338561, -0.9787684, 0.0719453, -1.6168667, 1.9161415, -0.2289914, -0.4906146,
                                   0.0334540, 1.4052427);
    const glm::dvec3 linear = kToLinear * xyz;
    std::array<std::uint8_t, 3> colour{};
    for (int i = 0; i < 3; ++i) {
        const double value = std::clamp(linear[i], 0.0, 1.0);
        const double curved = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
        colour[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * curved));
    }
    return colour;
}

} // namespace ramus::io
