// The registry of the work behind the window: what is missing, how it is made, where it goes, for each kind.
#pragma once

#include "app/workspace/background_work.h"
#include "app/workspace/compared_surfaces.h"

#include <functional>
#include <memory>
#include <vector>

namespace ramus::app {

// In the order of WorkKind. `compared` is where the surfaces to compare with go; it outlives the works.
[[nodiscard]] std::vector<std::unique_ptr<BackgroundWork>> background_works(const std::function<void()>& wake,
                                                                            std::vector<ComparedSurface>& compared);

} // namespace ramus::app
