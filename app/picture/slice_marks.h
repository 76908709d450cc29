// Measurements, pins and shortest distances on slices: full within the thickness of the slice, faint beyond it.
#pragma once

#include "app/picture/compose.h"
#include "core/slice/pixel_grid.h"
#include "render/slice/slice_view.h"

namespace ramus::app {

// How far from the plane a place may be to count as on the slice: half a slab, or half the step to the next slice.
[[nodiscard]] double slice_reach_mm(const Session& session, const Assets& assets, slice::Direction direction);

// Sets the marks and their labels of a slice whose grid is set. An object is shown on the slices that one of its lines
// meets: the part within reach is full, the rest faint.
void draw_marks(render::SliceView& view, const Session& session, const Assets& assets, slice::Direction direction,
                const Viewing& viewing);

} // namespace ramus::app
