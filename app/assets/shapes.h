// Surfaces that are read from files beside the tree.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"
#include "render/scene/bounds.h"

#include <compare>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

namespace ramus::app {

// A file that was read, and whether it has been written since.
struct FileStamp {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};

// What the file held when it was read last, or why it could not be read.
template <class T> struct Loaded {
    FileStamp stamp;
    Result<std::shared_ptr<const T>> value;
};

// `before` while the file is as it was then, even if it could not be read; otherwise the result of `read()`, a
// Result<std::shared_ptr<const T>>. `before` may be null; `what` names the file's content in messages: "the lesion".
template <class T, class Read>
[[nodiscard]] Loaded<T> read_if_written(const std::filesystem::path& file, const Loaded<T>* before, const char* what,
                                        Read read) {
    std::error_code error;
    FileStamp stamp{std::filesystem::last_write_time(file, error), 0};
    // A folder of slices has no size.
    if (!error && !std::filesystem::is_directory(file)) stamp.bytes = std::filesystem::file_size(file, error);
    if (error)
        return {{},
                fail(std::string(what) + " cannot be read: " + error.message(), file.string(),
                     "check the name and the folder")};
    if (before != nullptr && before->stamp == stamp) return *before;
    return {stamp, read()};
}

// The closed meshes that sessions name as lesions, read from their files.
struct LesionMesh {
    mesh::TriangleMesh mesh;                          // positions, normals and triangles
    std::shared_ptr<const mesh::TriangleMesh> coarse; // fewer triangles, for outlines; null: the mesh has few
    std::string asked_axes;                           // that it was read with
    tree::SaidBy axes = tree::SaidBy::kNobody;
    std::shared_ptr<const measure::MeshDistance> distance;
};

// The mesh in this file (core/io/meshes/mesh_file.h says which ones are taken), or `before` if the file was not written
// since; null: it was not read before. `axes`: "LPS" or "RAS", of a file that does not state them; empty: nobody says.
// Any thread.
[[nodiscard]] Loaded<LesionMesh> read_lesion_mesh(const std::filesystem::path& file, const std::string& axes,
                                                  const Loaded<LesionMesh>* before);

// The surfaces that sessions show beside the tree, read from meshes and masks.
struct ContextSource {
    std::string file;
    volume::LabelChoice label;                              // of a mask; none: all
    bool exact = false;                                     // of a mask: with the steps of its voxels
    std::string units = {};                                 // of the file's lengths; empty: as it says itself
    std::optional<double> isovalue{};                       // of a scan
    std::string axes = {};                                  // of a mesh that does not state them
    auto operator<=>(const ContextSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline ContextSource source_of(const ContextItem& item) {
    // Who looks at triangles wants the true ones.
    return {item.file, item.label, item.exact || item.wireframe, item.units, item.isovalue, item.axes};
}

struct ContextShape {
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    std::shared_ptr<const mesh::TriangleMesh> preview; // fewer triangles; null: the mesh has few
    std::string suspicion;                             // of a mask: that its unit is likely another; may be empty
    render::Box box;                                   // around it
    std::optional<volume::LabelName> label;            // what the file says of the label that was chosen
    tree::Claims claims;                               // who says its unit and its sides
};

// The mesh in this file, or the surface of the mask in it by marching cubes, without the steps of
// its voxels (core/volume/smooth_level.h) unless the exact one is asked for; or `before` if the file was not written
// since (null: it was not read before). When `job` is cancelled, the error's `what` is "cancelled", and the result must
// not be kept. Any thread.
[[nodiscard]] Loaded<ContextShape> read_context_shape(const ContextSource& source, const Loaded<ContextShape>* before,
                                                      Job& job);

// By its name, or its content: a mask or a mesh.
[[nodiscard]] bool can_be_context(const std::string& file);
[[nodiscard]] std::string context_extensions(); // ".nii, .nii.gz, .ply, .stl or .obj"

} // namespace ramus::app
