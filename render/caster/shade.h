// The caster's last stage: light. What shade.frag does for a picture at rest, with the same formulas (shaders/look).
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Colours of a tile while it is shaded.
struct alignas(64) Colours {
    float sum[kTilePixels][4];             // of the samples' linear colours, and the share of them that is there
    float front[kSamples][kTilePixels][4]; // glass: premultiplied, by sample
};

// Shades the tile whose lower left pixel is x, y into `rgba` (bytes in this order, sRGB, premultiplied; the picture's
// width in pixels a row). `glass`: what is seen through, without values, nearest first in each sample.
void shade_tile(const Shading& shading, const Records& records, const Records& glass, int x, int y,
                const PictureArrays& picture, Colours& colours, std::uint32_t* rgba);

} // namespace ramus::render::caster
