// What a kept measurement says: its value with a unit, in words, and what to draw for it. Derived from the tree:
// measurements hold only what was asked for (app/session/session.h).
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct Measured {
    std::string kind;   // "Distance", "Path", "Diameter", "Angle"
    std::string what{}; // "branch 3 to branch 17"
    double value = 0.0;
    std::string unit;                                           // "mm", "units" or "\u00B0"
    std::vector<std::pair<std::string, std::string>> details{}; // what belongs to it: ("cross-section", "12.6 mm2")
    std::vector<std::vector<glm::dvec3>> lines{};               // mm, RAS: what was measured, as polylines
    std::string label{};                                        // of the picture: "path 12.3 mm"
    glm::dvec3 label_place{0.0};                                // mm, RAS

    [[nodiscard]] std::string value_text() const; // "12.3 mm"
    [[nodiscard]] std::string sentence() const;   // "Path, branch 3 to branch 17: 12.3 mm"
};

// distance: straight, between its points. path: the shortest way along centerlines between the middles of its branches.
// diameter: at its fraction of the branch. angle: where the branch begins, between the way its parent comes and the
// branch, 0 being straight on; at a root between it and the first other branch there.
// Fails when there is no such branch, no such way or no branching.
[[nodiscard]] Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement);

// A session's measurements and what they say, in their order, or why they say nothing.
struct Measurements {
    std::vector<Measurement> of;
    std::vector<Result<Measured>> found;
};

} // namespace ramus::app
