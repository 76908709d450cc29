// Where the radii of a validation are farthest from what was read, and what vessel a place is at.
#pragma once

#include "core/validate/validation.h"

#include <cstddef>
#include <vector>

namespace ramus::validate {

// A branch by the place of it, away from joints, ends and other vessels, where the surface's radius is most off.
struct BranchError {
    int branch = 0;
    std::size_t first = 0, count = 0; // its places in Validation::radii
    std::size_t worst = 0;            // the place
    double error = 0.0;               // |surface - read| / read, there
};

// The `most` worst, the worst first. Branches without such a place are none of them.
[[nodiscard]] std::vector<BranchError> worst_branches(const Validation& found, std::size_t most);

// The place of the centerlines that is nearest to `at` (mm, RAS); null where there is none.
[[nodiscard]] const RadiusPlace* nearest_place(const Validation& found, const glm::dvec3& at);

} // namespace ramus::validate
