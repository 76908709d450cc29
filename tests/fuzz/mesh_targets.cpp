// The readers of meshes, by the table of formats.
#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/tree_file.h"
#include "tests/fuzz/target.h"

#include <cmath>

namespace ramus::fuzz {

namespace {

void read_mesh_bytes(std::string_view bytes, const std::string& name) {
    const std::string path = written_file(name, bytes);
    // Half of all files are read as people may ask for.
    const bool asked = bytes.size() % 2 == 0;
    const auto read = io::read_mesh_file(path, {asked ? io::Holes::kAllowed : io::Holes::kRefused,
                                                asked ? std::optional(io::Orientation::lps()) : std::nullopt});
    if (!read) return check_error(read.error(), path);
    must(asked || read->stated || read->axes == tree::SaidBy::kNobody, "a mesh has axes that nobody stated");
    const mesh::TriangleMesh* const mesh = &read->mesh;
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
        // VTK's formats are those of trees, too.
        const std::string target = (io::names_tree("a" + extension) ? "surface-" : "") + extension.substr(1);
        targets.push_back(
            {target, [name = "mesh" + extension](std::string_view bytes) { read_mesh_bytes(bytes, name); }});
    }
    return targets;
}

} // namespace ramus::fuzz
