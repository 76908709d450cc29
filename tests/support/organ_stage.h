// A session with an organ: two vessel systems in a box.
#pragma once

#include "app/assets/operation.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/two_systems.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

namespace ramus::test {

// Voxels of 1 mm whose centres are x -8..17, y -10..9, z -5..6. The axes of branches 1 and 2 mirror each other at y =
// 0, where ties go to branch 1.
inline constexpr int kAcross = 26, kDeep = 20, kHigh = 12, kVoxels = kAcross * kDeep * kHigh;

// Voxels nearer to the axis of branch 1 than to that of branch 2, or as near.
inline int first_voxels() {
    const auto away = [](const glm::dvec3& at, double side) {
        const glm::dvec3 end(10, 8 * side, 0);
        return glm::distance(at, std::clamp(glm::dot(at, end) / glm::dot(end, end), 0.0, 1.0) * end);
    };
    int count = 0;
    for (int x = -8; x < -8 + kAcross; ++x)
        for (int y = -10; y < -10 + kDeep; ++y)
            for (int z = -5; z < -5 + kHigh; ++z) count += away({x, y, z}, 1.0) <= away({x, y, z}, -1.0) + 1e-9 ? 1 : 0;
    return count;
}

struct OrganStage : CommandStage {
    OrganStage() : CommandStage(two_systems()) {
        NiftiFile file;
        file.dim = {3, kAcross, kDeep, kHigh, 1, 1, 1, 1};
        file.rows = {1, 0, 0, -8, 0, 1, 0, -10, 0, 0, 1, -5};
        file.put(std::vector<std::uint8_t>(kVoxels, 3));
        mask = write_plain(folder.path() / "organ.nii", file.bytes()).string();
        good("organ \"" + mask + "\"\norgan-by axis");
    }
    const app::OrganAssets& organ() {
        Job job;
        const auto complete = app::complete(assets, document, job);
        REQUIRE_MESSAGE(complete, (complete ? "" : complete.error().message()));
        return assets.organ;
    }
    std::shared_ptr<const app::Operation> operation(std::size_t plan = 0) {
        (void)organ();
        auto found = app::operation_of(assets, marks(), plan);
        REQUIRE(found);
        return found;
    }
    TemporaryFolder folder;
    std::string mask;
};

} // namespace ramus::test
