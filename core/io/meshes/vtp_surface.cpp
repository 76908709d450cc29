#include "core/io/meshes/vtp_surface.h"

#include "core/io/meshes/mesh_file.h"
#include "core/io/vtk/vtk_dataset.h"

#include <bit>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

namespace {

// Writes the XML elements first, with the offsets of their numbers, and the numbers after the last element.
class AppendedArrays {
public:
    // `write`: `count` tuples of `parts` numbers of `type`, each `size` bytes long.
    void add(std::string_view type, std::string_view name, std::size_t size, std::uint64_t count, int parts,
             std::function<void(BufferedFile&)> write) {
        text_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) +
                 "\" NumberOfComponents=\"" + std::to_string(parts) + "\" NumberOfTuples=\"" + std::to_string(count) +
                 "\" format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
        const std::uint64_t bytes = size * count * static_cast<std::uint64_t>(parts);
        offset_ += sizeof bytes + bytes;
        writers_.push_back([bytes, numbers = std::move(write)](BufferedFile& file) {
            file.write_value(bytes);
            numbers(file);
        });
    }

    void add(std::string_view name, const LargeArray<glm::vec3>& vectors) {
        add("Float32", name, sizeof(float), vectors.size(), 3,
            [&vectors](BufferedFile& file) { file.write(vectors.data(), vectors.size() * sizeof(glm::vec3)); });
    }

    void write_text(std::string_view text) { text_ += text; }

    void write_to(BufferedFile& file) const {
        file.write(text_);
        file.write("<AppendedData encoding=\"raw\">\n_");
        for (const auto& write : writers_) write(file);
        file.write("\n</AppendedData>\n");
    }

private:
    std::string text_;
    std::uint64_t offset_ = 0;
    std::vector<std::function<void(BufferedFile&)>> writers_;
};

void add_field_data(AppendedArrays& arrays, const MeshNames& of) {
    const std::vector<tree::System>& systems = of.systems;
    const std::string axes = axes_word(of.axes, of.claims);
    arrays.write_text("<FieldData>\n");
    arrays.write_text(vtk_text_array(kVtkMark, {std::string(of.claims.unit_word()), axes}));
    if (of.claims.has_sides()) arrays.write_text(vtk_text_array(kVtkSpace, {axes}));
    if (!systems.empty()) {
        std::vector<std::string> names;
        for (const tree::System& system : systems) names.push_back(system.name);
        arrays.write_text(vtk_text_array(kVtkSystemNames, names));
        arrays.add("UInt8", kVtkSystemColours, 1, systems.size(), 3, [&systems](BufferedFile& file) {
            for (const tree::System& system : systems) file.write_value(system.colour);
        });
    }
    arrays.write_text("</FieldData>\n");
}

void add_point_data(AppendedArrays& arrays, const mesh::TriangleMesh& mesh) {
    arrays.write_text(mesh.normals.empty() ? "<PointData>\n" : "<PointData Normals=\"Normals\">\n");
    if (!mesh.normals.empty()) arrays.add("Normals", mesh.normals);
    if (!mesh.radii.empty())
        arrays.add("Float32", "Radius", sizeof(float), mesh.radii.size(), 1,
                   [&mesh](BufferedFile& file) { file.write(mesh.radii.data(), mesh.radii.size() * sizeof(float)); });
    if (!mesh.branches.empty())
        arrays.add("Int32", kVtkBranchIds, sizeof(std::int32_t), mesh.branches.size(), 1, [&mesh](BufferedFile& file) {
            file.write(mesh.branches.data(), mesh.branches.size() * sizeof(std::int32_t));
        });
    arrays.write_text("</PointData>\n");
}

void add_cell_data(AppendedArrays& arrays, const mesh::TriangleMesh& mesh, const MeshNames& names) {
    arrays.write_text("<CellData>\n");
    if (!mesh.branches.empty()) {
        const std::size_t count = mesh.triangles.size();
        arrays.add("Int32", kVtkBranchIds, sizeof(std::int32_t), count, 1, [&mesh](BufferedFile& file) {
            for (const glm::uvec3& triangle : mesh.triangles) file.write_value(branch_of(triangle, mesh.branches));
        });
        if (!names.systems.empty() && names_all(names, mesh.branches))
            arrays.add("Int32", kVtkSystemIds, sizeof(std::int32_t), count, 1, [&mesh, &names](BufferedFile& file) {
                for (const glm::uvec3& triangle : mesh.triangles) {
                    const auto branch = static_cast<std::size_t>(branch_of(triangle, mesh.branches));
                    file.write_value(static_cast<std::int32_t>(names.branches[branch].system));
                }
            });
    }
    arrays.write_text("</CellData>\n");
}

// VTK keeps indices as 64 bits: 32 would be converted while reading.
void add_geometry(AppendedArrays& arrays, const mesh::TriangleMesh& mesh) {
    arrays.write_text("<Points>\n");
    arrays.add("Points", mesh.positions);
    arrays.write_text("</Points>\n<Polys>\n");
    const std::uint64_t count = mesh.triangles.size();
    arrays.add("Int64", "connectivity", sizeof(std::int64_t), 3 * count, 1, [&mesh](BufferedFile& file) {
        for (const glm::uvec3& t : mesh.triangles)
            for (int corner = 0; corner < 3; ++corner) file.write_value(static_cast<std::int64_t>(t[corner]));
    });
    arrays.add("Int64", "offsets", sizeof(std::int64_t), count, 1, [count](BufferedFile& file) {
        for (std::uint64_t triangle = 1; triangle <= count; ++triangle)
            file.write_value(static_cast<std::int64_t>(3 * triangle));
    });
    arrays.write_text("</Polys>\n");
}

} // namespace

void write_vtp_surface(const mesh::TriangleMesh& mesh, const MeshNames& names, BufferedFile& file) {
    AppendedArrays arrays;
    arrays.write_text("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                      "header_type=\"UInt64\">\n<!-- ramus " RAMUS_VERSION ", " +
                      MeshCounts{.claims = names.claims, .axes = names.axes}.claims_text() + " -->\n<PolyData>\n");
    add_field_data(arrays, names);
    arrays.write_text("<Piece NumberOfPoints=\"" + std::to_string(mesh.positions.size()) +
                      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                      std::to_string(mesh.triangles.size()) + "\">\n");
    add_point_data(arrays, mesh);
    add_cell_data(arrays, mesh, names);
    add_geometry(arrays, mesh);
    arrays.write_text("</Piece>\n</PolyData>\n");
    arrays.write_to(file);
    file.write("</VTKFile>\n");
}

} // namespace ramus::io
