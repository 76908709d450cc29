// Colours a surface by its deviation from another one, with a legend.
#pragma once

#include "app/assets/deviation.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

// The colour of surfaces without distances; occurs in no scale.
inline constexpr glm::vec3 kNotMeasuredColour{0.62F, 0.63F, 0.65F};

// mm per unit of the scale: a voxel's diagonal, or 1.
[[nodiscard]] double mm_per_unit(const DeviationChoice& choice, const SurfaceDeviation& deviation);
// The end of the scale, in its unit: the session's value, or 99 % of the distances rounded up to two digits.
[[nodiscard]] double scale_end(const DeviationChoice& choice, const SurfaceDeviation& deviation);

// Sets the frame's scale and legend. `deviation`: of the frame's own mesh; null: not measured. Branches get a neutral
// colour, so that places without distances have no colour of the scale.
void show_deviation(render::Frame& frame, const Marks& marks, const SurfaceDeviation* deviation);

// Sets the frame's surface: the version with distances if the frame shows them and they belong to this surface.
void put_surface(render::Frame& frame, const SurfaceDeviation& deviation, const SurfaceDeviation::Paged& mesh,
                 const SurfaceDeviation::Paged& preview);

} // namespace ramus::app
