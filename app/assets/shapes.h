// Reads surfaces from files next to the tree: lesions and context.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/resect/voxel_solid.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"
#include "render/scene/bounds.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace ramus::app {

// Detects whether a file was modified.
struct FileStamp {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};

// The content of a file when it was read, or why reading failed.
template <class T> struct Loaded {
    FileStamp stamp;
    Result<std::shared_ptr<const T>> value;
};

// Returns `before` if the file is unmodified, even if reading had failed; otherwise the result of `read()`, a
// Result<std::shared_ptr<const T>>. `before` may be null. `what` names the content in messages: "the lesion".
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

// The file of a lesion, and how it is read.
struct LesionSource {
    std::string file;
    std::string axes{}; // of a mesh that does not state them: "LPS"; empty: not specified
    bool mask = false;
    std::vector<volume::LabelChoice> labels{};             // of a mask; none: all
    std::string units{};                                   // of a mask's lengths; empty: as the file says
    auto operator<=>(const LesionSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline LesionSource source_of(const Lesion& lesion) {
    return {lesion.file, lesion.axes, lesion.of_mask(), lesion.labels, lesion.units};
}

// A closed mesh that a session uses as a lesion.
struct LesionMesh {
    mesh::TriangleMesh mesh;                          // positions, normals and triangles
    std::shared_ptr<const mesh::TriangleMesh> coarse; // fewer triangles, for outlines; null: the mesh is small
    tree::Claims claims;                              // origin of unit (of a mask) and orientation
    std::shared_ptr<const measure::MeshDistance> distance;
    double diameter_mm = 0.0;                          // the greatest distance between two places of its surface
    std::optional<double> volume_mm3{};                // of the voxels; none: not of a mask
    std::shared_ptr<const organ::VoxelSolid> voxels{}; // the boxes of its voxels; null: not of a mask
    std::string name{};                                // in the file; empty: none
};

// What a file has of lesions: one mesh, or the parts of a mask, the largest first.
struct LesionFile {
    std::vector<std::shared_ptr<const LesionMesh>> parts;
    std::size_t more = 0;    // smaller parts that are left out
    std::string suspicion{}; // of a mask: why its unit is implausible; empty: it is not
};
inline constexpr std::size_t kMostLesionParts = 50; // of a mask; a person reads the list

// Reads a mesh (formats: core/io/meshes/mesh_file.h), or all parts of a mask (core/organ/mask_lesions.h). Returns
// `before` if the file is unmodified (null: not read before). If `job` is cancelled, the error's `what` is "cancelled",
// and the result must not be kept. Thread-safe.
[[nodiscard]] Loaded<LesionFile> read_lesion_file(const LesionSource& source, const Loaded<LesionFile>* before,
                                                  Job& job);

// The source of a context surface: a mesh or a mask.
struct ContextSource {
    std::string file;
    volume::LabelChoice label;                              // of a mask; none: all
    bool exact = false;                                     // of a mask: keep the steps of its voxels
    std::string units = {};                                 // of the file's lengths; empty: as the file says
    std::optional<double> isovalue{};                       // of a scan
    std::string axes = {};                                  // of a mesh that does not state them
    auto operator<=>(const ContextSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline ContextSource source_of(const ContextItem& item) {
    // A wireframe should show the true triangles.
    return {item.file, item.label, item.exact || item.wireframe, item.units, item.isovalue, item.axes};
}

struct ContextShape {
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    std::shared_ptr<const mesh::TriangleMesh> preview; // fewer triangles; null: the mesh is small
    std::string suspicion;                             // of a mask: why its unit is implausible; empty: it is not
    render::Box box;                                   // around it
    std::optional<volume::LabelName> label;            // name of the chosen label in the file
    tree::Claims claims;                               // origin of unit and orientation
};

// Reads a mesh, or extracts the surface of a mask by marching cubes, smoothed (core/volume/smooth_level.h) unless
// `exact`. Returns `before` if the file is unmodified (null: not read before). If `job` is cancelled, the error's
// `what` is "cancelled", and the result must not be kept. Thread-safe.
[[nodiscard]] Loaded<ContextShape> read_context_shape(const ContextSource& source, const Loaded<ContextShape>* before,
                                                      Job& job);

// The mesh with fewer triangles, for pictures while the view moves; null: it is small.
[[nodiscard]] std::shared_ptr<const mesh::TriangleMesh> preview_of(const mesh::TriangleMesh& mesh);

// Whether the file is a mask or a mesh, by its name or content.
[[nodiscard]] bool can_be_context(const std::string& file);
[[nodiscard]] std::string context_extensions(); // ".nii, .nii.gz, .ply, .stl or .obj"

} // namespace ramus::app
