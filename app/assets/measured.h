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
    std::string what{}; // "branch 3 at 40 % to branch 17 at 5 %"
    double value = 0.0;
    std::string unit;                                           // "mm", "units" or "\u00B0"
    std::vector<std::pair<std::string, std::string>> details{}; // what belongs to it: ("cross-section", "12.6 mm2")
    std::vector<std::vector<glm::dvec3>> lines{};               // mm, RAS: what was measured, as polylines
    double inside_mm = 0.0;                                     // radius of the vessels that the lines run in
    std::vector<glm::dvec3> ends{};                             // mm, RAS: its points or places, in their order
    std::string label{};                                        // of the picture: "path 12.3 mm"
    glm::dvec3 label_place{0.0};                                // mm, RAS

    [[nodiscard]] std::string value_text() const; // "12.3 mm"
    [[nodiscard]] std::string sentence() const;   // "Distance, (1, 2, 3) to (1, 2, 9): 6.00 mm"
};

// distance: straight, between its points. path: the shortest way along centerlines between its places. diameter: at its
// place. angle: at the second of its places, between the straight lines to the others; of one place where the branch
// begins, between the way its parent comes and the branch, 0 being straight on; at a root between it and the first
// other branch there. Fails when there is no such branch, no such way, no branching or no angle.
[[nodiscard]] Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement);

// What it is between: its points or, on the centerlines, its places; none where a branch begins. Branches that there
// are not have none.
[[nodiscard]] std::vector<glm::dvec3> ends_of(const tree::VesselTree& tree, const Measurement& measurement);

// A session's measurements and what they say, in their order, or why they say nothing.
struct Measurements {
    std::vector<Measurement> of;
    std::vector<Result<Measured>> found;
};

} // namespace ramus::app
