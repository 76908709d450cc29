// The surfaces that sessions name as context, each read once. A session says file names only (app/session/session.h);
// pictures want the meshes: this keeps them. Safe to ask from any thread.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"

#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct ContextSource {
    std::string file;
    int label = 0;
    bool exact = false; // of a mask: with the steps of its voxels
    auto operator<=>(const ContextSource&) const = default;
};
[[nodiscard]] inline ContextSource source_of(const ContextItem& item) {
    return {item.file, item.label, item.exact || item.wireframe}; // who looks at triangles wants the true ones
}

struct ContextShape {
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    std::shared_ptr<const mesh::TriangleMesh> preview; // fewer triangles; null: the mesh has few
};

// The mesh in this file, or the surface of the mask in it by marching cubes, relaxed within its voxels
// (core/volume/relax_surface.h) unless it shall be exact. A file is read again when it was written
// since; one that could not be read says so again without another try until it changes. Fails with what == "cancelled"
// when `job` is.
[[nodiscard]] Result<std::shared_ptr<const ContextShape>> context_shape(const ContextSource& source, Job& job);

// The same without touching the disk or waiting for who does: null when it has not been read.
[[nodiscard]] std::shared_ptr<const ContextShape> context_shape_read_before(const ContextSource& source);
// Likewise why it could not be read; none when it was, or nobody has tried.
[[nodiscard]] std::optional<Error> context_trouble(const ContextSource& source);

// Reads all that is visible, and fails with the first that cannot be read.
[[nodiscard]] Result<void> read_context(const std::vector<ContextItem>& context, Job& job);

// Lets go of what is not named here.
void keep_context_shapes(const std::vector<ContextItem>& context);

// By the ending of its name: a mask or a mesh.
[[nodiscard]] bool can_be_context(const std::string& file);

} // namespace ramus::app
