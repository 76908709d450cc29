// Draws the territories of the organ, and explains their colours.
#pragma once

#include "app/assets/territories.h"
#include "app/picture/compose.h"
#include "render/scene/frame.h"

#include <glm/vec3.hpp>

namespace ramus::app {

// The colour of a part of `territories`: its system's, that of what remains, or one by its number.
[[nodiscard]] glm::vec3 territory_colour(const OrganTerritories& territories, std::size_t part, const Marks& marks);

// Draws their surfaces and adds them to the legend. Those of an earlier choice stay until they are replaced. `opacity`:
// trial value.
void draw_territories(render::Frame& frame, const Assets& assets, const Marks& marks, std::optional<double> opacity);

} // namespace ramus::app
