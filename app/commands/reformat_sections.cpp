#include "app/commands/reformat_sections.h"

#include "core/slice/mask_loops.h"

namespace ramus::app {

slice::LoopsOfPlane loops_of(const MaskVoxels& voxels, double half_mm) {
    return [&voxels, half_mm](const slice::Plane& plane) {
        return slice::mask_loops(voxels.inside, voxels.to_patient, plane, plane.point, half_mm);
    };
}

slice::LoopsOfPlane loops_of(const slice::MeshBlocks& blocks) {
    return [&blocks](const slice::Plane& plane) { return slice::section(blocks, plane); };
}

} // namespace ramus::app
