// The result of validating a surface against its tree (core/validate/validation.h; S. Oeltze and B. Preim, 2005) as a
// list of findings, for panels and tables. The surface has the session's options and all branches, including hidden
// ones. Validation takes seconds for large trees: use a worker (app/workspace/validation_maker.h).
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

// A place that fails one of the questions, or where the radius is far off.
struct Finding {
    enum class Kind : std::uint8_t { kLost, kFalse, kMerged, kConstriction, kWidth, kPosition, kRadius };
    Kind kind = Kind::kLost;
    std::vector<int> branches; // ascending; empty for a false part
    glm::dvec3 at{0.0};        // mm, RAS
    double radius_mm = 0.0;    // of the vessel, or half the length of a false part
    double value_mm = 0.0;     // length of the lost or false part; gap; radius of the surface; offset
    double expected_mm = 0.0;  // kConstriction, kWidth, kRadius: the correct radius
};
inline constexpr std::size_t kFindingKinds = 7;
[[nodiscard]] std::string_view name_of(Finding::Kind kind); // "lost", ..., "width", "position", "radius"
// "0.42 mm long", "gap 0.1 mm", "0.8 instead of 1.2 mm", "0.3 mm off".
[[nodiscard]] std::string text_of(const Finding& finding, const Lengths& lengths);
// Findings by question, followed by up to ten branches whose radii are off by 2 % or more, the worst first.
[[nodiscard]] std::vector<Finding> findings_of(const validate::Validation& found);

// Everything that a validation depends on.
struct ValidationOf {
    std::shared_ptr<const tree::VesselTree> tree;
    mesh::SurfaceOptions options;
    std::string mask, mask_units;            // of the comparison, for the curve of its radii; empty: no mask
    std::vector<volume::LabelChoice> labels; // of the mask
    bool operator==(const ValidationOf&) const = default;
};
[[nodiscard]] ValidationOf validation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks);

struct TreeValidation {
    ValidationOf of;
    std::shared_ptr<const validate::Validation> found;    // null: not validated yet
    std::shared_ptr<const std::vector<Finding>> findings; // with `found`
    std::vector<double> cones_mm, mask_mm;                // at the places of found->radii; empty: no such surface
    std::string mask_trouble;                             // why mask_mm is unavailable; empty: available, or no mask
    [[nodiscard]] bool fits(const ValidationOf& wanted) const { return found && of == wanted; }
};

} // namespace ramus::app
