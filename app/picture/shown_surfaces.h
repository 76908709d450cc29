// The meshes of a picture, by kind; null: not there yet.
#pragma once

#include "app/session/comparison.h"
#include "core/mesh/triangle_mesh.h"
#include "render/scene/paged_mesh.h"

#include <array>
#include <memory>
#include <utility>

namespace ramus::app {

struct ShownSurfaces {
    using Paged = std::shared_ptr<const render::PagedMesh>;
    std::array<Paged, mesh::kMethods.size()> meshes, previews;
    std::shared_ptr<const mesh::TriangleMesh> lines, lines_preview; // of the one that is superimposed
    [[nodiscard]] const Paged& of(mesh::Method kind) const { return meshes[static_cast<std::size_t>(kind)]; }
    [[nodiscard]] const Paged& preview_of(mesh::Method kind) const { return previews[static_cast<std::size_t>(kind)]; }
    void set(mesh::Method kind, Paged mesh, Paged preview) {
        meshes[static_cast<std::size_t>(kind)] = std::move(mesh);
        previews[static_cast<std::size_t>(kind)] = std::move(preview);
    }
};

} // namespace ramus::app
