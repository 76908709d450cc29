// The caster's last stage: light. What shade.frag does for a picture at rest.
#pragma once

#include "render/caster/cast_types.h"
#include "render/caster/panes.h"

namespace ramus::render::caster {

// Colours of a tile while it is shaded.
struct alignas(64) Colours {
    float sum[kTilePixels][4];             // of the samples' linear colours, and the share of them that is there
    float front[kSamples][kTilePixels][4]; // glass: premultiplied, by sample
};

// Shades a tile into `rgba` (bytes in this order, sRGB, premultiplied; `view.width` pixels a row).
void shade_tile(const View& view, const Shading& shading, const Records& records, const Panes& panes, int x, int y,
                const PictureArrays& picture, Colours& colours, std::uint32_t* rgba);

} // namespace ramus::render::caster
