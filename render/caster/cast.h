// The caster's first stage: cones to samples, samples to one value a pixel and to records to shade.
#pragma once

#include "render/caster/cast_types.h"

#include <cstddef>
#include <cstdint>

namespace ramus::render::caster {

// Casts the rays of the tile whose lower left pixel is (x, y) at `count` opaque cones, nearest first for speed alone.
void cast_tile(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
               bool with_values, int x, int y, Samples& samples);

// Fills the tile of `picture`, and `records` with what there is to shade.
void resolve_tile(const View& view, const Field& field, const Samples& samples, bool with_values, int x, int y,
                  const PictureArrays& picture, Records& records);

} // namespace ramus::render::caster
