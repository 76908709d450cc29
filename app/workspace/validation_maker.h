// Holds the surface of the session's options against its tree (app/assets/validation.h), for the window and for
// commands without one alike.
#pragma once

#include "app/assets/validation.h"
#include "core/base/error.h"
#include "core/base/job.h"

namespace ramus::app {

// Makes the surface, the cones and the mask's isosurface where there is a mask, and looks. A mask that cannot be had is
// told in the result. Fails as mesh::make_surface() and validate::validate() do.
[[nodiscard]] Result<TreeValidation> make_validation(const ValidationOf& of, Job& job);

} // namespace ramus::app
