// The caster's second stage: opaque triangles among the cones.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Lays the triangles into the samples of the tile whose lower left pixel is (x, y), after the cones.
void raster_tile(const View& view, const BlockTriangles& triangles, bool with_values, int x, int y, Samples& samples);

} // namespace ramus::render::caster
