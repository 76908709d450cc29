// What a surface was made with, as facts of a page.
#pragma once

#include "app/reports/html.h"
#include "core/mesh/surface_options.h"

namespace ramus::app {

[[nodiscard]] Facts surface_facts(const mesh::SurfaceOptions& options);

} // namespace ramus::app
