// Measures the deviation of the shown surface from another one, for the window, headless pictures and tests
// (core/measure/deviation; S. Oeltze and B. Preim, 2005, Figs. 8 and 9).
#pragma once

#include "app/assets/deviation.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <cstddef>

namespace ramus::app {

// Exact distances of all vertices of `mesh` and `preview`; the preview may be null. Fails if the other surface cannot
// be made or read, and if it does not overlap the tree.
[[nodiscard]] Result<SurfaceDeviation> make_deviation(const DeviationOf& of, int threads, std::size_t memory_bytes,
                                                      const SurfaceDeviation::Paged& mesh,
                                                      const SurfaceDeviation::Paged& preview, Job& job);

// The inputs of make_deviation().
struct DeviationWork {
    DeviationOf of;
    int threads = 0;
    std::size_t memory_bytes = 0;
    SurfaceDeviation::Paged mesh, preview;
    bool operator==(const DeviationWork&) const = default;
};

} // namespace ramus::app
