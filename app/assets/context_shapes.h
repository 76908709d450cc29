// The surfaces that sessions show beside the tree, read from meshes and masks.
#pragma once

#include "app/assets/loaded_file.h"
#include "app/session/session.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"

#include <compare>
#include <memory>
#include <string>

namespace ramus::app {

struct ContextSource {
    std::string file;
    int label = 0;
    bool exact = false;                                     // of a mask: with the steps of its voxels
    auto operator<=>(const ContextSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline ContextSource source_of(const ContextItem& item) {
    return {item.file, item.label, item.exact || item.wireframe}; // who looks at triangles wants the true ones
}

struct ContextShape {
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    std::shared_ptr<const mesh::TriangleMesh> preview; // fewer triangles; null: the mesh has few
};

// The mesh in this file, or the surface of the mask in it by marching cubes, relaxed within its voxels
// (core/volume/relax_surface.h) unless it shall be exact; or `before` if the file was not written since (null: it was
// not read before). When `job` is cancelled, the error's `what` is "cancelled", and the result must not be kept. Any
// thread.
[[nodiscard]] Loaded<ContextShape> read_context_shape(const ContextSource& source, const Loaded<ContextShape>* before,
                                                      Job& job);

// By the ending of its name: a mask or a mesh.
[[nodiscard]] bool can_be_context(const std::string& file);
[[nodiscard]] std::string context_extensions(); // ".nii, .nii.gz, .ply, .stl or .obj"

} // namespace ramus::app
