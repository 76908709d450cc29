// The branches with the largest errors of the radius in a validation, and the nearest place of the centerlines to a
// point.
#pragma once

#include "core/validate/validation.h"

#include <cstddef>
#include <vector>

namespace ramus::validate {

// A branch, with its place of the largest error among places that are alone.
struct BranchError {
    int branch = 0;
    std::size_t first = 0, count = 0; // its places in Validation::radii
    std::size_t worst = 0;            // the place
    double error = 0.0;               // |surface - input| / input at this place
};

// The `most` branches with the largest errors, in descending order. Skips branches without a place that is alone.
[[nodiscard]] std::vector<BranchError> worst_branches(const Validation& found, std::size_t most);

// The place of the centerlines that is nearest to `at` (mm, RAS); null if there is none.
[[nodiscard]] const RadiusPlace* nearest_place(const Validation& found, const glm::dvec3& at);

} // namespace ramus::validate
