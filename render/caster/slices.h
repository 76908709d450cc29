// Slices of a scan among the hits of the caster's rays: a stage between resolving and listing glass. The formulas are
// those of the shaders (shaders/look/slices.glsl), one pixel at a time.
#pragma once

#include "render/caster/cast_types.h"
#include "render/scene/scan_plane.h"

#include <vector>

namespace ramus::render {
struct Image;
}

namespace ramus::render::caster {

// The planes of a picture. References must outlive the object.
class Slicer {
public:
    Slicer(const PlanesBlock& block, const std::vector<ScanPlane>& planes);
    [[nodiscard]] bool reaches(const TileTask& tile) const;

    // Finds the slices that the tile's samples show and puts their depths into `samples`, where they cut glass. Drops
    // from `records` what they hide, and sets the picked depths where a slice is nearest. The opaque depths stay as
    // they are: slices take no light from vessels.
    void lay(const TileTask& tile, Samples& samples, const PictureArrays& picture, Records& records,
             std::vector<SlicePixel>& found) const;

private:
    const PlanesBlock& block_;
    const Image* pictures_[kMostPlanes] = {};
};

// The light, before tone mapping, that becomes each byte of a picture.
[[nodiscard]] const float* light_of_bytes();

} // namespace ramus::render::caster
