#include "core/io/mesh_writer.h"

#include "core/io/mesh_encoding.h"

#include <algorithm>
#include <string>

namespace ramus::io {

namespace {

void write_ply(const mesh::TriangleMesh& mesh, OutputFile& file) {
    const VertexArrays arrays{!mesh.normals.empty(), !mesh.radii.empty(), !mesh.branches.empty()};
    file.write(ply_header(arrays, mesh.positions.size(), mesh.triangles.size()));
    write_ply_vertices(vertices_of(mesh), file);
    for (const glm::uvec3& triangle : mesh.triangles) ply_face(triangle).write(file);
}

void write_stl(const mesh::TriangleMesh& mesh, OutputFile& file) {
    file.write(stl_header(mesh.triangles.size()));
    for (const glm::uvec3& t : mesh.triangles)
        stl_facet(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]).write(file);
}

void write_obj(const mesh::TriangleMesh& mesh, OutputFile& file) {
    file.write(obj_header());
    ObjLines lines(file);
    for (const glm::vec3& position : mesh.positions) lines.vector("v", position);
    for (const glm::vec3& normal : mesh.normals) lines.vector("vn", normal);
    for (const glm::uvec3& triangle : mesh.triangles) lines.face(triangle, !mesh.normals.empty());
}

} // namespace

Result<MeshFormat> mesh_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    if (extension == ".ply") return MeshFormat::kPly;
    if (extension == ".stl") return MeshFormat::kStl;
    if (extension == ".obj") return MeshFormat::kObj;
    return fail(extension.empty() ? "has no extension that names a mesh format"
                                  : "meshes of type '" + extension + "' cannot be written",
                file.string(), "use .ply, .stl or .obj");
}

Result<void> write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& path) {
    const auto format = mesh_format(path);
    if (!format) return tl::unexpected(format.error());
    if (mesh.positions.size() > kMostInFile || mesh.triangles.size() > kMostInFile)
        return too_many_for_file(path.string());
    auto file = OutputFile::create(path);
    if (!file) return tl::unexpected(file.error());
    switch (*format) {
    case MeshFormat::kPly:
        write_ply(mesh, *file);
        break;
    case MeshFormat::kStl:
        write_stl(mesh, *file);
        break;
    case MeshFormat::kObj:
        write_obj(mesh, *file);
        break;
    }
    return file->commit();
}

} // namespace ramus::io
