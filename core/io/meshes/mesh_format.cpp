#include "core/io/meshes/mesh_format.h"

#include "core/io/meshes/obj.h"
#include "core/io/meshes/ply_reader.h"
#include "core/io/meshes/ply_writer.h"
#include "core/io/meshes/stl.h"

namespace ramus::io {

const std::vector<MeshFormat>& mesh_formats() {
    static const std::vector<MeshFormat> table = {
        {{.name = "PLY",
          .extensions = {".ply"},
          .has_signature = is_ply,
          .help = "Binary; vertices with normal, radius and branch, where the mesh has them."},
         parse_ply,
         write_ply,
         keep_ply_vertices,
         keep_ply_triangles,
         write_ply_parts},
        {{.name = "STL", .extensions = {".stl"}, .help = "Binary; triangles with a normal each, for printing."},
         parse_stl,
         write_stl,
         keep_stl_vertices,
         keep_stl_triangles,
         write_stl_parts},
        {{.name = "OBJ", .extensions = {".obj"}, .help = "Text; vertices with normals, and triangles."},
         parse_obj,
         write_obj,
         keep_obj_vertices,
         keep_obj_triangles,
         write_obj_parts},
    };
    return table;
}

std::string readable_mesh_extensions() { return listed(readable_extensions(mesh_formats())); }
std::string writable_mesh_extensions() { return listed(writable_extensions(mesh_formats())); }

bool names_mesh(const std::filesystem::path& path) {
    const MeshFormat* format = format_by_name(mesh_formats(), path);
    return format != nullptr && is_read(*format);
}

Result<const MeshFormat*> mesh_format(const std::filesystem::path& file) {
    const MeshFormat* format = format_by_name(mesh_formats(), file);
    if (format != nullptr && is_written(*format)) return format;
    const std::string extension = file.extension().string();
    return fail(extension.empty() ? "has no extension that names a mesh format"
                                  : "meshes of type '" + extension + "' cannot be written",
                file.string(), "use " + writable_mesh_extensions());
}

} // namespace ramus::io
