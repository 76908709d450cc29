#include "core/io/meshes/mesh_format.h"

#include "core/io/meshes/assimp_reader.h"
#include "core/io/meshes/obj.h"
#include "core/io/meshes/ply.h"
#include "core/io/meshes/stl.h"

namespace ramus::io {

const std::vector<MeshFormat>& mesh_formats() {
    static const std::vector<MeshFormat> table = {
        {{.name = "PLY",
          .extensions = {".ply"},
          .has_signature = is_ply,
          .help = "Binary; vertices with normal, radius and branch, where the mesh has them."},
         false,
         parse_ply,
         ply_header,
         {write_ply_vertices},
         write_ply_faces},
        {{.name = "STL", .extensions = {".stl"}, .help = "Binary; triangles with a normal each, for printing."},
         false,
         [](auto text, const auto& name) { return parse_with_assimp(text, "stl", name); },
         stl_header,
         {},
         write_stl_facets},
        {{.name = "OBJ", .extensions = {".obj"}, .help = "Text; vertices with normals, and triangles."},
         true,
         [](auto text, const auto& name) { return parse_with_assimp(text, "obj", name); },
         obj_header,
         {write_obj_positions, write_obj_normals},
         write_obj_faces},
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
