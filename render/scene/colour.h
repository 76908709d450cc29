// From the bytes of a picture (sRGB) to linear light.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

[[nodiscard]] inline float linear(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}
[[nodiscard]] inline glm::vec4 linear(const glm::vec3& srgb, float w) {
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z), w};
}

} // namespace ramus::render
