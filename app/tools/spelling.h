// Formats numbers in the command lines of tools: positions to a hundredth of a millimetre, fractions to a thousandth;
// finely_spelled(): measured values to single precision, whatever the tree's unit.
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

[[nodiscard]] inline std::string finely_spelled(double value) {
    std::string text(64, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.7g", value)));
    return text;
}

[[nodiscard]] inline std::string finely_spelled(const glm::dvec3& position) {
    return finely_spelled(position.x) + "," + finely_spelled(position.y) + "," + finely_spelled(position.z);
}

} // namespace ramus::app
