// What the texts and objects of `ramus info` are made of.
#pragma once

#include <glm/vec3.hpp>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

namespace ramus::app {

// One finding on standard output: its name and what it is.
inline void print_fact(const std::string& name, const std::string& value) {
    std::cout << std::left << std::setw(14) << name << std::right << value << '\n';
}

inline nlohmann::ordered_json list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace ramus::app
