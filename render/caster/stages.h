// The stages of the ray caster. Each processes one tile, or two adjacent ones, and may run for several tiles in
// parallel. Order:
//
//   all tiles: cast_tile(), raster_tile(), resolve_tile(), split_depths(), Slicer::lay(), list_fragments()
//   all tiles: occlude_tiles(), shadow_tiles(); then smooth_tile(); then shade_tile()
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

// First stage: cones to samples, samples to one value per pixel and to records to shade.

// Casts the tile's rays at opaque cones.
void cast_tile(const TileTask& tile, const TileCones& cones, Samples& samples);

// Fills the tile of `picture`, and `records` with what is to be shaded.
void resolve_tile(const TileTask& tile, const Samples& samples, const PictureArrays& picture, Records& records);

// Second stage: draws opaque triangles among the cones.

// Draws the triangles into the tile's samples; call it after cast_tile().
void raster_tile(const TileTask& tile, const BlockTriangles& triangles, Samples& samples);

// Glass: the fragments that every sample sees, nearest first. The cones of a vessel tree overlap: a ray passes through
// glass from where it enters any cone until it has left all of them, which is one fragment, at the front.
inline constexpr std::size_t kMaxFragmentsOfTile = std::size_t{kTilePixels} * kSamples * kMaxFragments + 16;

// Lists the glass in front of the samples' opaque surfaces, nearest first: one list per pixel where all its samples see
// the same, else one per sample. Sets the picked id of pixels without an opaque surface to the glass they show; lesions
// take precedence. `in_pairs`: two samples of a pixel share one ray between them, which halves the work.
void list_fragments(const TileTask& tile, const BlockCones& cones, const BlockTriangles& triangles,
                    const Samples& samples, bool in_pairs, const PictureArrays& picture, Records& fragments);

// Third stage: ambient occlusion from the picture's depths, and denoising, as in occlusion.frag and
// occlusion_blur.frag.

// Offsets in pixels at which the occlusion of a pixel samples depths. Pixels whose columns and rows are equal modulo 4
// share them.
struct Taps {
    static constexpr int kMost = 32;
    int count;
    struct {
        std::int16_t x[kMost], y[kMost];
    } of[4][4]; // [row][column]
};
[[nodiscard]] Taps taps_of(const View& view);

// Each fills the tile or tiles whose lower left pixel is (x, y). Call order: split_depths() for the whole picture, then
// occlude_tiles(), then smooth_tile() once the tiles around are occluded.
void split_depths(int x, int y, const View& view, const PictureArrays& picture);
void occlude_tiles(const View& view, const Taps& taps, int x, int y, const PictureArrays& picture);
void smooth_tile(const View& view, int x, int y, const float* depths, const PictureArrays::Taken& taken);

// Shadows, as occlusion.frag computes them. Pixels whose columns and rows are equal modulo 4 share their ray;
// look/shadow_ray.glsl explains w.
struct ShadowRays {
    vec4 of[4][4]; // [row][column]
};
[[nodiscard]] ShadowRays shadow_rays();
void shadow_tiles(const View& view, const ShadowRays& rays, int x, int y, const PictureArrays& picture);

// Last stage: light, with the formulas of shade.frag (shaders/look).

// Colours of a tile during shading.
struct alignas(64) Colours {
    float sum[kTilePixels][4];             // of the samples' linear colours, and of their coverage
    float front[kSamples][kTilePixels][4]; // glass: premultiplied, by sample
};

// A tile to shade.
struct ShadedTile {
    int x, y; // lower left pixel
    Colours& colours;
    std::uint32_t* rgba;      // the whole picture: bytes in this order, sRGB, premultiplied, rows without padding
    const SlicePixel* slices; // slices of a scan, behind the glass
    std::size_t slice_count;
};

// `glass`: transparent surfaces, without values, nearest first in each sample.
void shade_tile(const Shading& shading, const Records& records, const Records& glass, const PictureArrays& picture,
                const ShadedTile& tile);

} // namespace ramus::render::caster
