// The side of planes and sheets that is removed, and resections from lines that are drawn across the picture.
#pragma once

#include "app/actions/action.h"

namespace ramus::app::actions {

// The organ of the session; fails if it is not read. Valid until the assets change.
[[nodiscard]] Result<const organ::Organ*> organ_read(const ActionContext& context);

// Makes a plane or a sheet remove the side that has all lesions, or else the smaller one. Fails as organ_read().
[[nodiscard]] Result<void> choose_side(const ActionContext& context, Resection& resection);

// `words`: pixels X,Y of the picture. `straight`: two, a plane along the line of sight; else a stroke of two or more
// across the organ, a sheet through the places where the lines of sight enter and leave it. choose_side() says what is
// removed. Fails if the organ is not read, or if the stroke misses it.
[[nodiscard]] Result<Resection> resection_drawn(const ActionContext& context, bool straight, Arguments words);

// The same of places (mm) of a plane across `normal`, for a line that is drawn on a slice: the lines of sight are along
// the normal.
[[nodiscard]] Result<Resection> resection_drawn_on_slice(const ActionContext& context, const glm::dvec3& normal,
                                                         const std::vector<glm::dvec3>& places);

} // namespace ramus::app::actions
