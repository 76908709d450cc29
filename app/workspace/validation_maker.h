// Validates the surface of the session's options against its tree (app/assets/validation.h), for the window and
// headless commands.
#pragma once

#include "app/assets/validation.h"
#include "core/base/error.h"
#include "core/base/job.h"

namespace ramus::app {

// Makes the surface, the cones and, with a mask, its isosurface, and compares them. The result reports a mask that
// cannot be used. Fails as mesh::make_surface() and validate::validate() do.
[[nodiscard]] Result<TreeValidation> make_validation(const ValidationOf& of, Job& job);

} // namespace ramus::app
