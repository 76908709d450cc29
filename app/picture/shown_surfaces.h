// The meshes of a picture by kind; null: not available yet.
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
    std::array<Paged, kCompared.size()> meshes, previews;
    std::shared_ptr<const mesh::TriangleMesh> lines, lines_preview; // of the superimposed surface
    [[nodiscard]] const Paged& of(Compared kind) const { return meshes[static_cast<std::size_t>(kind)]; }
    [[nodiscard]] const Paged& preview_of(Compared kind) const { return previews[static_cast<std::size_t>(kind)]; }
    void set(Compared kind, Paged mesh, Paged preview) {
        meshes[static_cast<std::size_t>(kind)] = std::move(mesh);
        previews[static_cast<std::size_t>(kind)] = std::move(preview);
    }
    // Sets the session's own surface for every kind that it represents.
    void set_own(const mesh::SurfaceOptions& options, const Paged& mesh, const Paged& preview) {
        for (const ComparedRow& row : kCompared)
            if (is_own(row.kind, options)) set(row.kind, mesh, preview);
    }
};

} // namespace ramus::app
