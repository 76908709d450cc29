// The readers of meshes, by the table of formats.
#include "core/io/meshes/mesh_file.h"
#include "tests/fuzz/target.h"

#include <cmath>

namespace ramus::fuzz {

namespace {

void read_mesh_bytes(std::string_view bytes, const std::string& name) {
    const std::string path = written_file(name, bytes);
    const auto mesh = io::read_mesh(path, bytes.size() % 2 == 0 ? io::Holes::kAllowed : io::Holes::kRefused);
    if (!mesh) return check_error(mesh.error(), path);
    must(mesh->normals.size() == mesh->positions.size(), "a mesh has more or fewer normals than vertices");
    for (const glm::uvec3& triangle : mesh->triangles)
        for (int corner = 0; corner < 3; ++corner)
            must(triangle[corner] < mesh->positions.size(), "a triangle has a vertex that is not there");
    for (const glm::vec3& position : mesh->positions)
        for (int axis = 0; axis < 3; ++axis) must(std::isfinite(position[axis]), "a position is not finite");
}

} // namespace

std::vector<Target> mesh_targets() {
    std::vector<Target> targets;
    for (const io::MeshFormat& format : io::mesh_formats()) {
        if (!io::is_read(format)) continue;
        const std::string extension(format.extensions.front());
        targets.push_back({extension.substr(1),
                           [name = "mesh" + extension](std::string_view bytes) { read_mesh_bytes(bytes, name); }});
    }
    return targets;
}

} // namespace ramus::fuzz
