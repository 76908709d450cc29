// The growing itself: fills an organ with a straight tree. See grow.h for what the result guarantees; here "do not
// touch" holds with some air between the straight tubes, so that bending has room.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/grow/organ.h"
#include "core/tree/grow/skeleton.h"

#include <functional>
#include <vector>

namespace ramus::tree::growth {

// A tree with exactly `branches` branches. `misplaced` looks at a finished tree and names segments that must not stay;
// they are cut out with all that hangs on them and as many terminals grown anew, until it names none.
[[nodiscard]] Result<Skeleton> colonise(const Organ& organ, double root_radius_mm, int branches, Random& random,
                                        const std::function<std::vector<int>(const Skeleton&)>& misplaced, Job& job);

} // namespace ramus::tree::growth
