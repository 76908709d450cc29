#include "core/io/meshes/mesh_file.h"
#include "tests/support/temporary_folder.h"

#include <cstring>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <sstream>

using namespace ramus;

namespace {

// A tetrahedron, outward oriented, with numbers that text must not round.
mesh::TriangleMesh tetrahedron() {
    mesh::TriangleMesh mesh;
    mesh.positions = {{0.1F, 0.2F, 0.3F}, {1.1F, 0.2F, 0.3F}, {0.1F, 1.0F / 3.0F, 0.3F}, {0.1F, 0.2F, 1e-7F}};
    mesh.normals = {glm::normalize(glm::vec3(-1, -1, 1)), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    mesh.radii = {0.5F, 0.25F, 0.125F, 1.0F / 3.0F};
    mesh.branches = {0, 7, -1, 123456};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

template <class T> T take(const std::string& bytes, std::size_t& at) {
    T value;
    REQUIRE(at + sizeof(T) <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    at += sizeof(T);
    return value;
}

} // namespace

TEST_CASE("PLY holds every vertex property and face, bit by bit") {
    TemporaryFolder folder;
    const mesh::TriangleMesh mesh = tetrahedron();
    REQUIRE(io::write_mesh(mesh, folder.path() / "m.ply"));
    const std::string bytes = folder.text("m.ply");
    std::size_t at = bytes.find("end_header\n");
    REQUIRE(at != std::string::npos);
    at += 11;
    const std::string header = bytes.substr(0, at);
    CHECK(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
    CHECK(header.find("element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
                      "property float ny\nproperty float nz\nproperty float radius\nproperty int branch\n"
                      "element face 4\nproperty list uchar int vertex_indices\nend_header\n") != std::string::npos);
    for (std::size_t v = 0; v < 4; ++v) {
        CHECK(take<glm::vec3>(bytes, at) == mesh.positions[v]);
        CHECK(take<glm::vec3>(bytes, at) == mesh.normals[v]);
        CHECK(take<float>(bytes, at) == mesh.radii[v]);
        CHECK(take<std::int32_t>(bytes, at) == mesh.branches[v]);
    }
    for (std::size_t t = 0; t < 4; ++t) {
        CHECK(take<std::uint8_t>(bytes, at) == 3);
        CHECK(take<glm::uvec3>(bytes, at) == mesh.triangles[t]);
    }
    CHECK(at == bytes.size());
}

TEST_CASE("PLY leaves out what a mesh lacks") {
    TemporaryFolder folder;
    mesh::TriangleMesh mesh = tetrahedron();
    mesh.normals.clear();
    mesh.radii.clear();
    mesh.branches.clear();
    REQUIRE(io::write_mesh(mesh, folder.path() / "m.PLY"));
    const std::string bytes = folder.text("m.PLY");
    const std::size_t start = bytes.find("end_header\n") + 11;
    CHECK(bytes.find("property float nx") == std::string::npos);
    CHECK(bytes.size() - start == 4 * 12 + 4 * 13);
}

TEST_CASE("STL holds each triangle with its outward normal") {
    TemporaryFolder folder;
    const mesh::TriangleMesh mesh = tetrahedron();
    REQUIRE(io::write_mesh(mesh, folder.path() / "m.stl"));
    const std::string bytes = folder.text("m.stl");
    CHECK_FALSE(bytes.starts_with("solid"));
    std::size_t at = 80;
    REQUIRE(take<std::uint32_t>(bytes, at) == 4);
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto normal = take<glm::vec3>(bytes, at);
        CHECK(glm::length(normal) == doctest::Approx(1.0));
        glm::vec3 corner[3];
        for (int c = 0; c < 3; ++c) {
            corner[c] = take<glm::vec3>(bytes, at);
            CHECK(corner[c] == mesh.positions[triangle[c]]);
        }
        CHECK(glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), normal) > 0.0F);
        take<std::uint16_t>(bytes, at);
    }
    CHECK(at == bytes.size());
}

TEST_CASE("OBJ reads back the very same numbers") {
    TemporaryFolder folder;
    const mesh::TriangleMesh mesh = tetrahedron();
    REQUIRE(io::write_mesh(mesh, folder.path() / "m.obj"));
    std::istringstream lines(folder.text("m.obj"));
    mesh::TriangleMesh read;
    for (std::string line; std::getline(lines, line);) {
        glm::vec3 v;
        glm::uvec3 f;
        glm::uvec3 n;
        if (std::sscanf(line.c_str(), "v %f %f %f", &v.x, &v.y, &v.z) == 3) read.positions.push_back(v);
        if (std::sscanf(line.c_str(), "vn %f %f %f", &v.x, &v.y, &v.z) == 3) read.normals.push_back(v);
        if (std::sscanf(line.c_str(), "f %u//%u %u//%u %u//%u", &f.x, &n.x, &f.y, &n.y, &f.z, &n.z) == 6) {
            CHECK(f == n);
            read.triangles.push_back(f - 1U);
        }
    }
    CHECK(read.positions == mesh.positions);
    CHECK(read.normals == mesh.normals);
    CHECK(read.triangles == mesh.triangles);
}

TEST_CASE("an unknown mesh format is refused with those that are known") {
    for (const char* name : {"m.xyz", "m", "m.ply.gz", ".ply"}) {
        const auto format = io::mesh_format(name);
        REQUIRE_FALSE(format);
        CHECK(format.error().message().find(".ply, .stl, .obj, .vtp, .pvtp or .glb") != std::string::npos);
    }
}
