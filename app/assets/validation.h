// What holding the tree's surface against the tree has found (core/validate/validation.h; S. Oeltze and B. Preim,
// 2005), as a list to go through, for panels and tables. The surface is the one of the session's options with all
// branches, hidden ones too. Making it takes seconds where the tree is large: a worker's task
// (app/workspace/validation_maker.h).
#pragma once

#include "app/session/numbers.h"
#include "app/session/session.h"
#include "core/mesh/surface_options.h"
#include "core/tree/vessel_tree.h"
#include "core/validate/validation.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// An answer to one of the questions, or a place where the radius is far off.
struct Finding {
    enum class Kind : std::uint8_t { kLost, kFalse, kMerged, kConstriction, kWidth, kPosition, kRadius };
    Kind kind = Kind::kLost;
    std::vector<int> branches; // ascending; none of a false part
    glm::dvec3 at{0.0};        // mm, RAS
    double radius_mm = 0.0;    // of the vessel there, or half the length of a false part
    double value_mm = 0.0;     // length of what is lost or false; gap; radius of the surface; offset
    double expected_mm = 0.0;  // of kConstriction, kWidth, kRadius: the radius that it should have
};
inline constexpr std::size_t kFindingKinds = 7;
[[nodiscard]] std::string_view name_of(Finding::Kind kind); // "lost", ..., "width", "position", "radius"
// "0.42 mm long", "gap 0.1 mm", "0.8 instead of 1.2 mm", "0.3 mm off".
[[nodiscard]] std::string text_of(const Finding& finding, const Lengths& lengths);
// Question by question, then where the radii of up to ten branches are off by 2 % or more, the worst first.
[[nodiscard]] std::vector<Finding> findings_of(const validate::Validation& found);

// Everything that a validation depends on.
struct ValidationOf {
    std::shared_ptr<const tree::VesselTree> tree;
    mesh::SurfaceOptions options;
    std::string mask, mask_units;            // of the comparison, for the curve of its radii; empty: there is none
    std::vector<volume::LabelChoice> labels; // in the mask
    bool operator==(const ValidationOf&) const = default;
};
[[nodiscard]] ValidationOf validation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks);

struct TreeValidation {
    ValidationOf of;
    std::shared_ptr<const validate::Validation> found;    // null: nobody has looked yet
    std::shared_ptr<const std::vector<Finding>> findings; // with `found`
    std::vector<double> cones_mm, mask_mm; // at the places of found->radii; none: there is no such surface beside it
    std::string mask_trouble;              // why the mask's cannot be had; empty: they can, or there is no mask
    [[nodiscard]] bool fits(const ValidationOf& wanted) const { return found && of == wanted; }
};

} // namespace ramus::app
