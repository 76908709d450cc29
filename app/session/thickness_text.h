// Describes the result of measure::least_thicknesses() as text.
#pragma once

#include "app/session/numbers.h"
#include "core/measure/wall_thickness.h"

#include <span>
#include <string>

namespace ramus::app {

// Thinner printed vessels break: two lines of a printer's nozzle of 0.4 mm.
inline constexpr double kThinnestPrintedMm = 0.8;

[[nodiscard]] std::string place_text(const measure::Thickness& thickness); // "branch 12 at (1.5, -20.1, 33.4)"

// "closed, in mm; thinnest place 0.62 mm, branch 12 at (1.5, -20.1, 33.4)"; for all thicknesses of a closed surface.
[[nodiscard]] std::string printing_text(std::span<const measure::Thickness> thicknesses, const Lengths& lengths);

// The thicknesses below `least_mm`; the input must be ascending.
[[nodiscard]] std::span<const measure::Thickness> thinner_than(std::span<const measure::Thickness> thicknesses,
                                                               double least_mm);

// "3 branches are thinner than 0.8 mm, the thinnest with 0.62 mm (branch 12 at (1.5, -20.1, 33.4)): they may break or
// not be printed"; empty if there are none.
[[nodiscard]] std::string thin_text(std::span<const measure::Thickness> thicknesses, double least_mm,
                                    const Lengths& lengths);

} // namespace ramus::app
