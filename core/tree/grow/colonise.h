// Fills an organ with a tree of straight segments. grow.h states the guarantees; here vessels keep an additional
// distance from each other, so that there is room for bending.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/grow/organ.h"
#include "core/tree/grow/skeleton.h"

#include <functional>
#include <vector>

namespace ramus::tree::growth {

// Grows a tree with exactly `branches` branches. `misplaced` returns the segments of a finished tree that must not
// stay. These are removed with their descendants, and as many terminals are grown again, until it returns none.
[[nodiscard]] Result<Skeleton> colonise(const Organ& organ, double root_radius_mm, int branches, Random& random,
                                        const std::function<std::vector<int>(const Skeleton&)>& misplaced, Job& job);

} // namespace ramus::tree::growth
