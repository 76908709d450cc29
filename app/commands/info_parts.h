// Helpers for the text and JSON output of `ramus info`.
#pragma once

#include <glm/vec3.hpp>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

namespace ramus::app {

// Prints a line with a name and a value on standard output. Values are aligned.
inline void print_fact(const std::string& name, const std::string& value) {
    std::cout << std::left << std::setw(14) << name << std::right << value << '\n';
}

// [x, y, z]
inline nlohmann::ordered_json list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace ramus::app
