// The registry of background work, one entry per kind.
#pragma once

#include "app/workspace/background_work.h"
#include "app/workspace/compared_surfaces.h"

#include <functional>
#include <memory>
#include <vector>

namespace ramus::app {

// In the order of WorkKind. `compared` receives the surfaces of comparisons and must outlive the result.
[[nodiscard]] std::vector<std::unique_ptr<BackgroundWork>> background_works(const std::function<void()>& wake,
                                                                            std::vector<ComparedSurface>& compared);

} // namespace ramus::app
