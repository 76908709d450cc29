// The caster's glass: what of it every sample sees, nearest first. The cones of one vessel tree overlap, so that a ray
// goes through glass from where it enters any of them to where it has left all of them: one pane, at its front.
#pragma once

#include "render/caster/cast_types.h"

namespace ramus::render::caster {

inline constexpr std::size_t kMostPanesOfTile = std::size_t{kTilePixels} * kSamples * kMostPanes + 16;

// What lies before the samples' opaque surfaces: pixel by pixel, those of all its samples together where they are the
// same, else sample by sample; nearest first. Pixels of `picture` without anything opaque are picked as the glass they
// show, lesions before all else.
void list_panes(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
                const BlockTriangles& triangles, int x, int y, const Samples& samples, const PictureArrays& picture,
                Records& panes);

} // namespace ramus::render::caster
