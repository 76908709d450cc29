// The caster's second stage: opaque triangles among the cones.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Draws the triangles into the tile's samples, after the cones.
void raster_tile(const TileTask& tile, const BlockTriangles& triangles, Samples& samples);

} // namespace ramus::render::caster
