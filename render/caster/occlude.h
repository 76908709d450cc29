// The caster's second and third stage: ambient occlusion from the picture's depths, and its noise removed; what
// occlusion.frag and occlusion_blur.frag do.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Both fill the tile whose lower left pixel is (x, y). Depths must be there for the whole picture, occlusion for the
// tiles around when it is smoothed.
void occlude_tile(const View& view, int x, int y, const PictureArrays& picture);
void smooth_tile(const View& view, int x, int y, const PictureArrays& picture);

} // namespace ramus::render::caster
