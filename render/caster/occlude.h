// The caster's second and third stage: ambient occlusion from the picture's depths, and its noise removed; what
// occlusion.frag and occlusion_blur.frag do.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// Where the occlusion of a pixel looks, pixels from there: the same for all whose column and row are the same modulo 4.
struct Taps {
    static constexpr int kMost = 32;
    int count;
    struct {
        std::int16_t x[kMost], y[kMost];
    } of[4][4]; // [row][column]
};
[[nodiscard]] Taps taps_of(const View& view);

// Each fills the tile, or tiles, whose lower left pixel is (x, y). Depths must have been dealt for the whole picture
// when it is occluded, and occlusion be there for the tiles around when it is smoothed.
void split_depths(int x, int y, const View& view, const PictureArrays& picture);
void occlude_tiles(const View& view, const Taps& taps, int x, int y, const PictureArrays& picture);
void smooth_tile(const View& view, int x, int y, const PictureArrays& picture);

} // namespace ramus::render::caster
