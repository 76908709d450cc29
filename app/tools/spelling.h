// Numbers as tools write them into command lines: positions to a hundredth of a millimetre, fractions to a thousandth.
#pragma once

#include <cstdio>
#include <glm/vec3.hpp>
#include <string>

namespace ramus::app {

[[nodiscard]] inline std::string spelled(double value, int decimals = 2) {
    std::string text(64, '\0');
    const int length = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    text.resize(static_cast<std::size_t>(length));
    return text == "-0.00" ? "0.00" : text;
}

[[nodiscard]] inline std::string spelled(const glm::dvec3& position) {
    return spelled(position.x) + "," + spelled(position.y) + "," + spelled(position.z);
}

} // namespace ramus::app
