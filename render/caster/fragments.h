// The caster's glass: the fragments of it that every sample sees, nearest first. The cones of one vessel tree overlap,
// so that a ray goes through glass from where it enters any of them to where it has left all of them: one fragment, at
// its front.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

inline constexpr std::size_t kMaxFragmentsOfTile = std::size_t{kTilePixels} * kSamples * kMaxFragments + 16;

// What lies before the samples' opaque surfaces: pixel by pixel, fragments of all its samples together where they are
// the same, else sample by sample; nearest first. Pixels of `picture` without anything opaque are picked as the glass
// they show, lesions before all else.
void list_fragments(const TileTask& tile, const TileCones& cones, const BlockTriangles& triangles,
                    const Samples& samples, const PictureArrays& picture, Records& fragments);

} // namespace ramus::render::caster
