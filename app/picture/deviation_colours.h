// The colours of a surface by how far it lies from another one, and what the legend says of them.
#pragma once

#include "app/assets/deviation.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

// Of a surface whose distances are not known: no colour of a scale.
inline constexpr glm::vec3 kNotMeasuredColour{0.62F, 0.63F, 0.65F};

// mm a unit of the scale: a voxel's diagonal, or 1.
[[nodiscard]] double mm_per_unit(const DeviationChoice& choice, const SurfaceDeviation& deviation);
// Where the scale ends, in its unit: as the session says or, with two digits, above 99 % of the distances.
[[nodiscard]] double scale_end(const DeviationChoice& choice, const SurfaceDeviation& deviation);

// Gives the frame scale and legend; `deviation` of the frame's own mesh, or null where that is not measured. Colours of
// branches are neutral: where the picture shows no distances it shows none of the scale's colours.
void show_deviation(render::Frame& frame, const Marks& marks, const SurfaceDeviation* deviation);

// Gives the frame this surface; the one with distances, where the frame shows them and they are of it.
void put_surface(render::Frame& frame, const SurfaceDeviation& deviation, const SurfaceDeviation::Paged& mesh,
                 const SurfaceDeviation::Paged& preview);

} // namespace ramus::app
