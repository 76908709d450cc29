// Moves of the slice that follows a vessel, for commands that move slices.
#pragma once

#include "app/actions/action.h"

namespace ramus::app::actions {

// The path's step is half a voxel; a step of the slice is one voxel.
inline constexpr double kStepsOfPath = 2.0;

// Fails if slices follow no vessel. Steps beyond an end stop there.
[[nodiscard]] Result<void> step_along_vessel(ActionContext& context, double steps);

// Whether the oblique slice lies across the vessel that slices follow, where it was moved last.
[[nodiscard]] bool oblique_follows(const ActionContext& context);

} // namespace ramus::app::actions
