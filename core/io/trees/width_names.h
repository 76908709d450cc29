// What files call the width of a vessel, and what their words say about it: which of several names is the surest, and
// whether it is that of a radius or of a diameter.
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
    bool open = false; // the name does not say which of both
};

// The surest first. VMTK: MaximumInscribedSphereRadius; its network extraction and Slicer's extension: Radius; Amira:
// thickness.
inline constexpr WidthName kWidthNames[] = {
    {"maximuminscribedsphereradius", RadiusIs::kRadius, false},
    {"radius", RadiusIs::kRadius, false},
    {"radii", RadiusIs::kRadius, false},
    {"diameter", RadiusIs::kDiameter, false},
    {"diameters", RadiusIs::kDiameter, false},
    {"thickness", RadiusIs::kRadius, true},
    {"width", RadiusIs::kDiameter, true},
};

// What `name` says, in capitals or not; none: it does not speak of widths.
[[nodiscard]] std::optional<WidthName> width_by_word(std::string_view name);

struct ChosenWidth {
    std::size_t index = 0; // of the names
    RadiusIs is = RadiusIs::kRadius;
    bool open = false;
};

// The name that a person asked for as the column "radius", else the surest of them, of equal ones the first. None: no
// name is that one, or speaks of widths.
[[nodiscard]] std::optional<ChosenWidth> choose_width(const std::vector<std::string>& names,
                                                      const ReadOptions& options);

} // namespace ramus::io
