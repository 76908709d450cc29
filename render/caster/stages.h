// What the caster does with a tile or two at a time, stage by stage.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// The caster's first stage: cones to samples, samples to one value a pixel and to records to shade.

// Casts the tile's rays at opaque cones.
void cast_tile(const TileTask& tile, const TileCones& cones, Samples& samples);

// Fills the tile of `picture`, and `records` with what there is to shade.
void resolve_tile(const TileTask& tile, const Samples& samples, const PictureArrays& picture, Records& records);

// The caster's second stage: opaque triangles among the cones.

// Draws the triangles into the tile's samples, after the cones.
void raster_tile(const TileTask& tile, const BlockTriangles& triangles, Samples& samples);

// The caster's glass: the fragments of it that every sample sees, nearest first. The cones of one vessel tree overlap,
// so that a ray goes through glass from where it enters any of them to where it has left all of them: one fragment, at
// its front.
inline constexpr std::size_t kMaxFragmentsOfTile = std::size_t{kTilePixels} * kSamples * kMaxFragments + 16;

// What lies before the samples' opaque surfaces: pixel by pixel, fragments of all its samples together where they are
// the same, else sample by sample; nearest first. Pixels of `picture` without anything opaque are picked as the glass
// they show, lesions before all else.
// `in_pairs`: two samples of a pixel look along one ray in between, for half of the work.
void list_fragments(const TileTask& tile, const BlockCones& cones, const BlockTriangles& triangles,
                    const Samples& samples, bool in_pairs, const PictureArrays& picture, Records& fragments);

// The caster's second and third stage: ambient occlusion from the picture's depths, and its noise removed; what
// occlusion.frag and occlusion_blur.frag do.

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
void smooth_tile(const View& view, int x, int y, const float* depths, const PictureArrays::Taken& taken);

// Shadows, likewise; what occlusion.frag does for them. Rays are the same for all pixels whose column and row are the
// same modulo 4; of what is in w see look/shadow_ray.glsl.
struct ShadowRays {
    vec4 of[4][4]; // [row][column]
};
[[nodiscard]] ShadowRays shadow_rays();
void shadow_tiles(const View& view, const ShadowRays& rays, int x, int y, const PictureArrays& picture);

// The caster's last stage: light. What shade.frag does for a picture at rest, with the same formulas (shaders/look).

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
