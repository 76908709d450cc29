#include "core/io/meshes/mesh_file.h"

#include "core/io/inflate.h"
#include "core/io/input_file.h"
#include "core/io/meshes/assimp_reader.h"
#include "core/io/meshes/glb.h"
#include "core/io/meshes/obj.h"
#include "core/io/meshes/ply.h"
#include "core/io/meshes/pvtp_surface.h"
#include "core/io/meshes/stl.h"
#include "core/io/meshes/vtk_surface.h"
#include "core/io/meshes/vtp_surface.h"
#include "core/io/output_file.h"
#include "core/io/recognise.h"
#include "core/io/standard_input.h"
#include "core/io/vtk/vtk_dataset.h"
#include "core/mesh/close_mesh.h"
#include "core/tree/build_tree.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

namespace ramus::io {

namespace {

bool sensible(const glm::dvec3& p) {
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(p[k]) || std::abs(p[k]) > tree::kMaximumCoordinate) return false;
    return true;
}

Result<mesh::TriangleMesh> triangles_of(const PolygonSoup& soup, const Orientation& axes, const std::string& name) {
    mesh::TriangleMesh mesh;
    for (const glm::dvec3& p : soup.positions) {
        if (!sensible(p))
            return fail("a coordinate is not a number of mm that makes sense", name,
                        "check the unit and the program that wrote it");
        mesh.positions.push_back(glm::vec3(axes.to_patient(p)));
    }
    std::vector<glm::dvec3> corners;
    for (const auto& polygon : soup.polygons) {
        corners.clear();
        for (const std::uint32_t v : polygon) corners.push_back(soup.positions[v]);
        for (const glm::uvec3& t : mesh::cut_polygon(corners)) // of points and lines: none
            mesh.triangles.push_back({polygon[t.x], polygon[t.y], polygon[t.z]});
    }
    return mesh;
}

// All bytes of the file, uncompressed.
Result<std::string> uncompressed(const std::filesystem::path& path, std::uintmax_t most_bytes) {
    RAMUS_TRY(text, read_file(path, most_bytes));
    if (!is_gzip(text)) return std::move(text);
    return inflated(text, std::min<std::uintmax_t>(inflation_limit(text.size()), most_bytes), path.string());
}

void turn_into(const Orientation& axes, mesh::TriangleMesh& mesh) {
    if (axes == Orientation::ras()) return;
    for (auto* vectors : {&mesh.positions, &mesh.normals})
        for (glm::vec3& vector : *vectors) vector = glm::vec3(axes.to_file(glm::dvec3(vector)));
}

Result<void> write_vtp_whole(const mesh::TriangleMesh& mesh, const MeshNames& names, const std::string& /*where*/,
                             BufferedFile& file) {
    write_vtp_surface(mesh, names, file);
    return {};
}

std::vector<MeshFormat> formats_of_triangles() {
    return {
        {{.name = "PLY",
          .extensions = {".ply"},
          .has_signature = is_ply,
          .help = "Binary; vertices with normal, radius and branch, where the mesh has them."},
         parse_ply,
         ply_header,
         write_ply_faces,
         {write_ply_vertices}},
        {{.name = "STL",
          .extensions = {".stl"},
          .has_signature = is_stl,
          .certainty = Certainty::kLikeness,
          .help = "Binary; triangles with a normal each, for printing."},
         parse_stl,
         stl_header,
         write_stl_facets},
        {{.name = "OBJ",
          .extensions = {".obj"},
          .has_signature = is_obj,
          .certainty = Certainty::kLikeness,
          .help = "Text; vertices with normals, and triangles."},
         parse_obj,
         obj_header,
         write_obj_faces,
         {write_obj_positions, write_obj_normals}},
    };
}

// Formats with names and colours.
std::vector<MeshFormat> formats_of_scenes() {
    return {
        {{.name = "VTP surface",
          .extensions = {".vtp"},
          .has_signature = is_vtk_poly_data,
          .certainty = Certainty::kHeader,
          .help = "PolyData of VTK: triangles with normals, radius, branch and system."},
         parse_vtk_xml_surface,
         nullptr,
         nullptr,
         {},
         write_vtp_whole},
        {{.name = "PVTP surface",
          .extensions = {".pvtp"},
          .help = "PolyData of VTK in several files, for ParaView on many processors."},
         nullptr,
         nullptr,
         nullptr,
         {},
         write_pvtp_surface,
         false,
         1.0,
         false,
         true},
        {{.name = "VTU surface",
          .extensions = {".vtu"},
          .has_signature = is_vtk_unstructured_grid,
          .certainty = Certainty::kHeader,
          .help = "Unstructured grid of VTK: its cells that are faces."},
         parse_vtk_xml_surface},
        {{.name = "Legacy VTK surface",
          .extensions = {".vtk"},
          .has_signature = is_vtk_legacy,
          .help = "Polygons and triangle strips of VTK, as text or binary."},
         parse_vtk_legacy_surface},
        {{.name = "GLB",
          .extensions = {".glb"},
          .has_signature = is_glb,
          .help = "glTF 2.0 in binary, for browsers and Blender: a named, coloured object for each system or branch."},
         parse_glb,
         nullptr,
         nullptr,
         {},
         write_glb,
         true,
         1000.0,
         true},
    };
}

} // namespace

const std::vector<MeshFormat>& mesh_formats() {
    static const std::vector<MeshFormat> table = [] {
        std::vector<MeshFormat> all = formats_of_triangles();
        for (MeshFormat& format : formats_of_scenes()) all.push_back(std::move(format));
        return all;
    }();
    return table;
}

std::string MeshCounts::claims_text() const {
    return std::string(claims.has_unit() ? "mm" : "unit unknown") + ", " +
           (claims.has_sides() ? axes.letters() + "; " + space_word(axes) : "orientation unknown");
}

std::string readable_mesh_extensions() { return listed(readable_extensions(mesh_formats())); }
std::string writable_mesh_extensions() { return listed(writable_extensions(mesh_formats())); }

bool names_mesh(const std::filesystem::path& path) {
    const MeshFormat* format = format_by_name(mesh_formats(), without_gz(path));
    return format != nullptr && is_read(*format);
}

bool may_be_mesh(const std::filesystem::path& path) { return recognised(path).mesh != nullptr; }

bool is_mesh(const std::filesystem::path& path) {
    const Recognised found = recognised(path);
    if (found.mesh == nullptr || found.tree == nullptr) return found.mesh != nullptr;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false; // a pipe can be read only once
    if (const auto by_counts = vtk_surface_by_counts(head_of(path))) return *by_counts;
    constexpr std::uintmax_t kMostTreeBytes = std::uintmax_t{4} << 30; // more than a mesh may have
    const auto text = uncompressed(path, kMostTreeBytes);
    return text && is_vtk_surface(*text);
}

Result<const MeshFormat*> mesh_format(const std::filesystem::path& file) {
    const MeshFormat* format = format_by_name(mesh_formats(), file);
    if (format != nullptr && is_written(*format)) return format;
    const std::string extension = file.extension().string();
    return fail(extension.empty() ? "has no extension that names a mesh format"
                                  : "meshes of type '" + extension + "' cannot be written",
                file.string(), "use " + writable_mesh_extensions());
}

Result<MeshFile> read_mesh_file(const std::filesystem::path& path, const MeshReading& reading) {
    const std::string name = input_name(path);
    RAMUS_TRY(text, uncompressed(path, kMostMeshBytes));
    const Recognised found = recognised(text, path);
    if (found.mesh == nullptr)
        return fail("a mesh is a file of type " + readable_mesh_extensions(), name, "convert it to one of these");
    if (text.empty()) return fail("the file is empty", name, "write it again");
    RAMUS_TRY(soup, found.mesh->parse(text, name));
    MeshFile read;
    read.stated = soup.orientation;
    if (read.stated || reading.orientation) read.axes = read.stated ? tree::SaidBy::kFile : tree::SaidBy::kPerson;
    const Orientation axes = read.stated.value_or(reading.orientation.value_or(Orientation::ras()));
    RAMUS_TRY(loose, triangles_of(soup, axes, name));
    RAMUS_TRY(tidied, reading.holes == Holes::kAllowed ? mesh::tidy_mesh(std::move(loose), name)
                                                       : mesh::closed_mesh(std::move(loose), name));
    read.mesh = std::move(tidied);
    return read;
}

Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes) {
    RAMUS_TRY(read, read_mesh_file(path, {holes, {}}));
    return std::move(read.mesh);
}

Result<void> write_mesh(mesh::TriangleMesh mesh, const std::filesystem::path& path, const MeshNames& names) {
    RAMUS_TRY(format, mesh_format(path));
    if (mesh.positions.size() > kMostInFile || mesh.triangles.size() > kMostInFile)
        return fail("the mesh has more triangles than its format can count", path.string(), "use a lower --detail");
    RAMUS_TRY(file, OutputFile::create(path));
    turn_into(names.axes, mesh);
    if (has_names(*format)) {
        if (auto written = format->whole(mesh, names, path.string(), file); !written) return written;
        return file.commit();
    }
    const mesh::VertexSpan vertices = vertices_of(mesh);
    file.write(format->header({mesh.positions.size(), mesh.triangles.size(), !mesh.normals.empty(), !mesh.radii.empty(),
                               !mesh.branches.empty(), names.claims, names.axes}));
    for (const auto write : format->vertices)
        if (write != nullptr) write(vertices, file);
    format->triangles(mesh.triangles, vertices, file);
    return file.commit();
}

} // namespace ramus::io
