// The works of scans: reading them, growing a region in one, and the sections across the vessel that slices follow.
#pragma once

#include "app/workspace/background_work.h"

#include <functional>
#include <memory>

namespace ramus::app {

[[nodiscard]] std::unique_ptr<BackgroundWork> scan_work(const std::function<void()>& wake);
[[nodiscard]] std::unique_ptr<BackgroundWork> region_work(const std::function<void()>& wake);
[[nodiscard]] std::unique_ptr<BackgroundWork> section_work(const std::function<void()>& wake);

} // namespace ramus::app
