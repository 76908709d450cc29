// The options of a surface as facts for a page.
#pragma once

#include "app/reports/html.h"
#include "core/mesh/surface_options.h"

namespace ramus::app {

[[nodiscard]] Facts surface_facts(const mesh::SurfaceOptions& options);

} // namespace ramus::app
