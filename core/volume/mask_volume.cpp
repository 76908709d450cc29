#include "core/volume/mask_volume.h"

#include <utility>

namespace ramus::volume {

Volume mask_volume(const SparseMask& mask, const Volume& like) {
    const glm::ivec3& size = mask.size();
    VoxelRuns runs;
    const auto fill_to = [&](std::size_t end, std::uint16_t value) {
        if (end > runs.size()) runs.add(value, end - runs.size());
    };
    std::size_t row = 0; // the first voxel
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j, row += static_cast<std::size_t>(size.x))
            for_row_runs(mask, j, k, [&](int first, int end) {
                fill_to(row + static_cast<std::size_t>(first), 0);
                fill_to(row + static_cast<std::size_t>(end), 1);
            });
    fill_to(voxel_count(size), 0);
    Volume volume;
    volume.size = size;
    volume.to_patient = like.to_patient;
    volume.voxels = std::move(runs);
    volume.maximum = 1.0;
    volume.type = "mask";
    volume.unit_mm = like.unit_mm;
    volume.notes = like.notes;
    return volume;
}

} // namespace ramus::volume
