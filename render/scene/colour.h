// Conversion between sRGB and linear light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

[[nodiscard]] inline float linear(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}
[[nodiscard]] inline glm::vec4 linear(const glm::vec3& srgb, float w) {
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z), w};
}
// Linear light of each sRGB byte.
[[nodiscard]] inline std::array<float, 256> linear_of_bytes() {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = linear(static_cast<float>(i) / 255.0F);
    return light;
}
template <class Real> [[nodiscard]] std::uint8_t srgb_byte(Real linear) {
    const Real c = std::clamp(linear, Real(0), Real(1));
    const Real srgb = c <= Real(0.0031308) ? Real(12.92) * c : Real(1.055) * std::pow(c, 1 / Real(2.4)) - Real(0.055);
    return static_cast<std::uint8_t>(std::lround(255 * srgb));
}

} // namespace ramus::render
