// Units of length as files and people name them: the one table of them.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

// How many mm one unit of the file is, along each axis: for voxels that are no cubes they differ.
struct LengthUnit {
    glm::dvec3 mm{1.0};
    bool operator==(const LengthUnit&) const = default;
};

// mm in a unit that has a name: "mm", "um", "cm", "m", "nm", "in" and their long names, in any case. None: it is none.
[[nodiscard]] std::optional<double> named_unit_mm(std::string_view name);

// A unit by its name, or a size of voxels in mm: "0.62" or "0.3x0.3x0.6". None: it is none of these.
[[nodiscard]] std::optional<LengthUnit> length_unit(std::string_view text);
[[nodiscard]] std::string name_of(const LengthUnit& unit); // "cm"; "0.3 x 0.3 x 0.6 mm"

} // namespace ramus::io
