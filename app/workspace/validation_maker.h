// Holds the surface of the session's options against its tree (app/assets/validation.h), for the window and for
// commands without one alike.
#pragma once

#include "app/assets/validation.h"
#include "app/workspace/missing_maker.h"

#include <functional>
#include <utility>

namespace ramus::app {

// Makes the surface, the cones and the mask's isosurface where there is a mask, and looks. A mask that cannot be had is
// told in the result. Fails as mesh::make_surface() and validate::validate() do.
[[nodiscard]] Result<TreeValidation> make_validation(const ValidationOf& of, Job& job);

// On a worker.
class ValidationMaker : public MissingMaker<ValidationOf, TreeValidation> {
public:
    explicit ValidationMaker(std::function<void()> wake)
        : MissingMaker(std::move(wake), "Validating the surface", make_validation) {}
};

} // namespace ramus::app
