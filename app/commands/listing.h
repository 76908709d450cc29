// What commands that list findings share.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace ramus::app {

inline constexpr std::size_t kMostListed = 20; // a person reads no more; JSON has them all

// [x, y, z], without negative zeros.
[[nodiscard]] inline nlohmann::ordered_json place_json(const glm::dvec3& at) {
    return {at.x + 0.0, at.y + 0.0, at.z + 0.0};
}

} // namespace ramus::app
