// Pieces, cavities and Euler number of a mask, counted the slow way: pieces over 26 neighbours, cavities over 6, and
// cells of the union of all voxels as closed cubes.
#pragma once

#include "core/volume/bit_mask.h"

#include <cstdlib>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::test {

struct VoxelTopology {
    int pieces = 0, cavities = 0;
    long euler = 0; // pieces - tunnels + cavities
};

inline VoxelTopology voxel_topology(const volume::BitMask& mask) {
    VoxelTopology counts;
    const glm::ivec3 grid = mask.size() + 2; // with a rim of outside
    const auto index = [&](const glm::ivec3& v) {
        return static_cast<std::size_t>(v.x + 1 + grid.x * (v.y + 1 + grid.y * (v.z + 1)));
    };
    const auto each = [](const glm::ivec3& low, const glm::ivec3& high, auto visit) {
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i) visit(glm::ivec3(i, j, k));
    };
    const glm::ivec3 low(-1);
    const glm::ivec3 high = mask.size();
    std::vector<bool> seen(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z));
    int outsides = 0;
    each(low, high, [&](const glm::ivec3& first) {
        if (seen[index(first)]) return;
        seen[index(first)] = true;
        const bool inside = mask.test(first);
        ++(inside ? counts.pieces : outsides);
        std::vector<glm::ivec3> waiting{first};
        while (!waiting.empty()) {
            const glm::ivec3 at = waiting.back();
            waiting.pop_back();
            each(glm::ivec3(-1), glm::ivec3(1), [&](const glm::ivec3& step) {
                const glm::ivec3 next = at + step;
                for (int axis = 0; axis < 3; ++axis)
                    if (next[axis] < low[axis] || next[axis] > high[axis]) return;
                if (!inside && std::abs(step.x) + std::abs(step.y) + std::abs(step.z) != 1) return;
                if (seen[index(next)] || mask.test(next) != inside) return;
                seen[index(next)] = true;
                waiting.push_back(next);
            });
        }
    });
    counts.cavities = outsides - 1;
    // A cell of the union, of any dimension, at half steps: even coordinates are between voxels, odd ones within.
    each(glm::ivec3(0), 2 * mask.size(), [&](const glm::ivec3& cell) {
        const glm::ivec3 from((cell.x - 1) >> 1, (cell.y - 1) >> 1, (cell.z - 1) >> 1);
        const glm::ivec3 to(cell.x >> 1, cell.y >> 1, cell.z >> 1);
        bool covered = false;
        each(from, to, [&](const glm::ivec3& voxel) { covered = covered || mask.test(voxel); });
        if (covered) counts.euler += ((cell.x + cell.y + cell.z) & 1) != 0 ? -1 : 1;
    });
    return counts;
}

} // namespace ramus::test
