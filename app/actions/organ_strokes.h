// Resections from lines that are drawn across the picture.
#pragma once

#include "app/actions/action.h"

namespace ramus::app::actions {

// `words`: pixels X,Y of the picture. `straight`: two, a plane along the line of sight; else a stroke of three or more
// across the organ, a sheet through the places where the lines of sight enter and leave it. Removed is the side that
// has all lesions, or else the smaller one. Fails if the organ is not read, or if the stroke misses it.
[[nodiscard]] Result<Resection> resection_drawn(const ActionContext& context, bool straight, Arguments words);

} // namespace ramus::app::actions
