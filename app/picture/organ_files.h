// Writes the parts of an organ, such as its territories: as a label map on the grid of its mask, or as closed surfaces.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/organ.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace ramus::app {

struct OrganParts {
    const organ::Organ& organ;
    tree::Claims claims;
    std::vector<std::string> names;
    std::vector<glm::vec3> colours; // sRGB, one for each name
};
// With the colours of labels.
[[nodiscard]] OrganParts parts_of(const organ::Organ& organ, const tree::Claims& claims,
                                  std::vector<std::string> names);

// part_of(number): the index of the part of a voxel of the organ + 1; 0: none. Fails as io::write_label_map().
[[nodiscard]] Result<void> write_organ_labels(const OrganParts& parts,
                                              const std::function<std::uint16_t(std::size_t)>& part_of,
                                              const std::filesystem::path& file, const JobRange& job);

struct PartSurface {
    std::string name, file; // of the part
    std::size_t triangles = 0;
};
// `surfaces`: by part; those without triangles are left out. VTP and GLB hold all of them, with names and colours;
// other formats get a file each, whose name ends in that of the part: liver.stl becomes "liver-branch 7.stl".
[[nodiscard]] Result<std::vector<PartSurface>> write_organ_surfaces(const OrganParts& parts,
                                                                    std::vector<mesh::TriangleMesh> surfaces,
                                                                    const std::filesystem::path& file);

} // namespace ramus::app
