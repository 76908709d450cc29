// Parses and names units of length. The only table of units in ramus.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

// The length of one unit of a file in mm, along each axis. The axes differ if the unit is an anisotropic voxel.
struct LengthUnit {
    glm::dvec3 mm{1.0};
    bool operator==(const LengthUnit&) const = default;
};

// The length in mm of the unit "mm", "um", "cm", "m", "nm" or "in", or its long name, case-insensitive. None: unknown.
[[nodiscard]] std::optional<double> named_unit_mm(std::string_view name);

// Parses the name of a unit, or a voxel size in mm such as "0.62" or "0.3x0.3x0.6", with or without "mm" after it.
// None: the text is neither.
[[nodiscard]] std::optional<LengthUnit> length_unit(std::string_view text);
[[nodiscard]] std::string name_of(const LengthUnit& unit); // "cm"; "0.3 x 0.3 x 0.6 mm"

} // namespace ramus::io
