// How far the surface that is shown lies from another one: measured for the window, pictures without one and tests
// alike (core/measure/deviation; S. Oeltze and B. Preim, 2005, Figs. 8 and 9).
#pragma once

#include "app/assets/deviation.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <cstddef>

namespace ramus::app {

// Exact distances of all vertices of both; the preview may be null. Fails as making or reading the other surface does,
// and when that lies elsewhere than the tree.
[[nodiscard]] Result<SurfaceDeviation> make_deviation(const DeviationOf& of, int threads, std::size_t memory_bytes,
                                                      const SurfaceDeviation::Paged& mesh,
                                                      const SurfaceDeviation::Paged& preview, Job& job);

// What is measured for the surface that is shown.
struct DeviationWork {
    DeviationOf of;
    int threads = 0;
    std::size_t memory_bytes = 0;
    SurfaceDeviation::Paged mesh, preview;
    bool operator==(const DeviationWork&) const = default;
};

} // namespace ramus::app
