#include "core/io/meshes/pvtp_surface.h"

#include "core/base/sort_unique.h"
#include "core/io/meshes/vtp_surface.h"
#include "core/io/output_file.h"
#include "core/io/vtk/vtk_dataset.h"

#include <algorithm>
#include <filesystem>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

constexpr std::size_t kUsualPiece = 8'000'000; // triangles

// The triangles [first, end), with the vertices that they have. `number`: by vertex; keeps what other pieces wrote.
mesh::TriangleMesh piece_of(const mesh::TriangleMesh& mesh, std::size_t first, std::size_t end,
                            LargeArray<std::uint32_t>& number) {
    std::vector<std::uint32_t> used;
    used.reserve(3 * (end - first));
    for (std::size_t t = first; t < end; ++t)
        for (int corner = 0; corner < 3; ++corner) used.push_back(mesh.triangles[t][corner]);
    sort_unique(used);
    mesh::TriangleMesh piece;
    const auto take = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to.reserve(used.size());
        for (const std::uint32_t v : used) to.push_back(from[v]);
    };
    take(mesh.positions, piece.positions);
    take(mesh.normals, piece.normals);
    take(mesh.radii, piece.radii);
    take(mesh.branches, piece.branches);
    for (std::uint32_t n = 0; n < used.size(); ++n) number[used[n]] = n;
    piece.triangles.reserve(end - first);
    for (std::size_t t = first; t < end; ++t) {
        const glm::uvec3& triangle = mesh.triangles[t];
        piece.triangles.push_back({number[triangle.x], number[triangle.y], number[triangle.z]});
    }
    return piece;
}

void add_array(pugi::xml_node to, const char* type, std::string_view name, int parts) {
    pugi::xml_node array = to.append_child("PDataArray");
    array.append_attribute("type") = type;
    array.append_attribute("Name") = std::string(name).c_str();
    array.append_attribute("NumberOfComponents") = parts;
}

// The arrays of all pieces, as write_vtp_surface() writes them.
void add_arrays(const mesh::TriangleMesh& mesh, const MeshNames& names, pugi::xml_node data) {
    pugi::xml_node points = data.append_child("PPointData");
    if (!mesh.normals.empty()) add_array(points, "Float32", "Normals", 3);
    if (!mesh.radii.empty()) add_array(points, "Float32", "Radius", 1);
    if (!mesh.branches.empty()) add_array(points, "Int32", kVtkBranchIds, 1);
    pugi::xml_node cells = data.append_child("PCellData");
    if (!mesh.branches.empty()) add_array(cells, "Int32", kVtkBranchIds, 1);
    if (!names.systems.empty() && names_all(names, mesh.branches)) add_array(cells, "Int32", kVtkSystemIds, 1);
    add_array(data.append_child("PPoints"), "Float32", "Points", 3);
}

} // namespace

Result<void> write_pvtp_surface(const mesh::TriangleMesh& mesh, const MeshNames& names, const std::string& where,
                                BufferedFile& file) {
    const std::size_t triangles = mesh.triangles.size();
    const std::size_t usual = (triangles + kUsualPiece - 1) / kUsualPiece;
    const std::size_t pieces = names.pieces > 0 ? names.pieces : std::max<std::size_t>(usual, 1);
    const std::filesystem::path target(where);
    pugi::xml_document document;
    pugi::xml_node root = document.append_child("VTKFile");
    root.append_attribute("type") = "PPolyData";
    root.append_attribute("version") = "1.0";
    root.append_attribute("byte_order") = "LittleEndian";
    root.append_attribute("header_type") = "UInt64";
    pugi::xml_node data = root.append_child("PPolyData");
    data.append_attribute("GhostLevel") = 0;
    add_arrays(mesh, names, data);
    LargeArray<std::uint32_t> number(mesh.memory());
    number.resize(mesh.positions.size());
    std::vector<OutputFile> written;
    for (std::size_t n = 0; n < pieces; ++n) {
        const std::string name = target.stem().string() + "_" + std::to_string(n) + ".vtp";
        RAMUS_TRY(output, OutputFile::create(target.parent_path() / name));
        write_vtp_surface(piece_of(mesh, triangles * n / pieces, triangles * (n + 1) / pieces, number), names, output);
        written.push_back(std::move(output));
        data.append_child("Piece").append_attribute("Source") = name.c_str();
    }
    std::ostringstream text;
    document.save(text, " ");
    file.write(text.str());
    return commit_all(written);
}

} // namespace ramus::io
