// `ramus reformat`: the loops in which planes cut a surface and a mask.
#pragma once

#include "app/commands/surface_input.h"
#include "core/slice/cross_section.h"

namespace ramus::app {

// Loops of a mask. `voxels` must outlive them. `half_mm`: about the extent of the vessel.
[[nodiscard]] slice::LoopsOfPlane loops_of(const MaskVoxels& voxels, double half_mm);
[[nodiscard]] slice::LoopsOfPlane loops_of(const slice::MeshBlocks& blocks); // `blocks` must outlive them

} // namespace ramus::app
