// Lesions of a mask: the parts of each of its labels that do not touch by faces, each as a closed surface.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/resect/voxel_solid.h"
#include "core/volume/label_choice.h"
#include "core/volume/volume.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ramus::organ {

struct MaskLesion {
    std::string name;        // "tumour"; "tumour 2" if the label has several parts; empty: the label has no name
    mesh::TriangleMesh mesh; // mm, RAS, with normals; the guarantees of surface_of() (label_surfaces.h)
    std::shared_ptr<const VoxelSolid> solid; // its voxels' boxes
    std::size_t voxels = 0;
    double volume_mm3 = 0.0; // of the voxels
};

struct MaskLesions {
    std::vector<MaskLesion> lesions; // the largest first; at most as many as asked for
    std::size_t more = 0;            // parts that were left out, all of them smaller or as large
};

// Each of `labels` is divided on its own, so lesions of different labels may touch; none: all labels of the mask. Fails
// if a label has no voxel or there is none at all (volume::inside()), and when cancelled (what == "cancelled").
[[nodiscard]] Result<MaskLesions> mask_lesions(const volume::Volume& volume,
                                               const std::vector<volume::LabelChoice>& labels, std::size_t most,
                                               const JobRange& job);

} // namespace ramus::organ
