// Helpers for commands that list findings.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace ramus::app {

inline constexpr std::size_t kMostListed = 20; // in text output; JSON lists all

// A position as [x, y, z]. Adding 0 turns -0 into 0.
[[nodiscard]] inline nlohmann::ordered_json place_json(const glm::dvec3& at) {
    return {at.x + 0.0, at.y + 0.0, at.z + 0.0};
}

} // namespace ramus::app
