// Describes the size of a lesion and its relation to nearby vessels, for panels, messages and pictures. Figures only,
// no assessment.
#pragma once

#include "app/assets/shapes.h"
#include "app/session/numbers.h"
#include "app/session/session.h"
#include "core/measure/lesion_contact.h"

#include <string>

namespace ramus::app {

// "portal vein"; "vessels" if the tree has fewer than two systems.
[[nodiscard]] std::string vessels_name(const tree::VesselTree& tree, const Marks& marks,
                                       const measure::LesionVessels& vessels);
// "4.20 mm"; "0 mm" if the two touch, "0 mm, overlap 1.30 mm" if they overlap.
[[nodiscard]] std::string distance_text(const measure::NearestWall& nearest, const Lengths& lengths);
// "contact 140° over 12.0 mm", with the other branches that the lesion touches; "no contact".
[[nodiscard]] std::string contact_text(const measure::LesionVessels& vessels, const Lengths& lengths);
// "Ø 31.2 mm, 12.3 ml": its largest diameter, and of a mask its volume. `lengths`: of the tree; a mask has its own
// unit.
[[nodiscard]] std::string size_text(const LesionMesh& mesh, const Lengths& lengths);
inline constexpr const char* kLargestDiameter = "the greatest distance between two places of the lesion's surface";

} // namespace ramus::app
