#include "app/assets/lesion_meshes.h"

#include "core/io/meshes/mesh_file.h"

namespace ramus::app {

Loaded<LesionMesh> read_lesion_mesh(const std::filesystem::path& file, const Loaded<LesionMesh>* before) {
    return read_if_written(file, before, "the lesion", [&]() -> Result<std::shared_ptr<const LesionMesh>> {
        auto mesh = io::read_mesh(file);
        if (!mesh) return tl::unexpected(mesh.error());
        auto distance = std::make_shared<const measure::MeshDistance>(*mesh);
        return std::make_shared<const LesionMesh>(LesionMesh{std::move(*mesh), std::move(distance)});
    });
}

} // namespace ramus::app
