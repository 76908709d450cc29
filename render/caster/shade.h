// The caster's last stage: light. What shade.frag does for a picture at rest, with the same formulas (shaders/look).
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Colours of a tile while it is shaded.
struct alignas(64) Colours {
    float sum[kTilePixels][4];             // of the samples' linear colours, and the share of them that is there
    float front[kSamples][kTilePixels][4]; // glass: premultiplied, by sample
};

// A tile that is shaded.
struct ShadedTile {
    int x, y; // lower left pixel
    Colours& colours;
    std::uint32_t* rgba; // of the picture: bytes in this order, sRGB, premultiplied; its width in pixels a row
};

// `glass`: what is seen through, without values, nearest first in each sample.
void shade_tile(const Shading& shading, const Records& records, const Records& glass, const PictureArrays& picture,
                const ShadedTile& tile);

} // namespace ramus::render::caster
