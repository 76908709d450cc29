// Writes the surfaces of territories: `ramus territories --surfaces FILE`.
#pragma once

#include "app/commands/organ_case.h"
#include "core/base/error.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

// Fails, before any work, if the extension names no format of meshes that is written.
[[nodiscard]] Result<void> check_surfaces_output(const std::string& file);

struct TerritorySurface {
    std::string name, file; // of the territory
    std::size_t triangles = 0;
};

// Writes the closed surface of each territory that has voxels. VTP and GLB hold all of them, with names and colours;
// other formats get a file each, whose name ends in that of the territory: liver.stl becomes "liver-branch 7.stl".
// `groups`: by voxel of the organ, the index in `names` (core/organ/territories.h).
[[nodiscard]] Result<std::vector<TerritorySurface>> write_territory_surfaces(const OrganCase& read,
                                                                             const std::vector<std::string>& names,
                                                                             std::span<const int> groups,
                                                                             const std::string& file);

} // namespace ramus::app
