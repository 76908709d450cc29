// The caster's first stage: cones to samples, samples to one value a pixel and to records to shade.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Casts the tile's rays at opaque cones.
void cast_tile(const TileTask& tile, const TileCones& cones, Samples& samples);

// Fills the tile of `picture`, and `records` with what there is to shade.
void resolve_tile(const TileTask& tile, const Samples& samples, const PictureArrays& picture, Records& records);

} // namespace ramus::render::caster
