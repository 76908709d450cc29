// Finds the array of vessel widths in a file by its name, and whether the name means a radius or a diameter.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct WidthName {
    std::string_view name;
    RadiusIs is = RadiusIs::kRadius;
    bool open = false; // the name can mean both
};

// The most reliable first. VMTK: MaximumInscribedSphereRadius; VMTK's network extraction and Slicer's extension:
// Radius; Amira: thickness.
inline constexpr WidthName kWidthNames[] = {
    {"maximuminscribedsphereradius", RadiusIs::kRadius, false},
    {"radius", RadiusIs::kRadius, false},
    {"radii", RadiusIs::kRadius, false},
    {"diameter", RadiusIs::kDiameter, false},
    {"diameters", RadiusIs::kDiameter, false},
    {"thickness", RadiusIs::kRadius, true},
    {"width", RadiusIs::kDiameter, true},
};

// The meaning of `name`, case-insensitive. None: it is no name of a width.
[[nodiscard]] std::optional<WidthName> width_by_word(std::string_view name);

struct ChosenWidth {
    std::size_t index = 0; // of the names
    RadiusIs is = RadiusIs::kRadius;
    bool open = false;
};

// The name that a person chose as the column "radius", else the most reliable one, the first of equals. None: the
// chosen name is not there, or no name is that of a width.
[[nodiscard]] std::optional<ChosenWidth> choose_width(const std::vector<std::string>& names,
                                                      const ReadOptions& options);

} // namespace ramus::io
