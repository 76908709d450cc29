#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/obj.h"
#include "core/mesh/close_mesh.h"
#include "tests/support/icosphere.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/peak_memory.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <sys/stat.h>

using namespace ramus;

namespace {

double enclosed(const mesh::TriangleMesh& mesh) { return test::topology(mesh).volume; }

std::string text_stl(const mesh::TriangleMesh& mesh) {
    std::string text = "solid lesion\n";
    for (const glm::uvec3& t : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh.positions[t[k]];
            text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid lesion\n";
}

std::string text_ply(const mesh::TriangleMesh& mesh) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                       std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const glm::vec3& p : mesh.positions)
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    for (const glm::uvec3& t : mesh.triangles)
        text += "3 " + std::to_string(t.x) + " " + std::to_string(t.y) + " " + std::to_string(t.z) + "\n";
    return text;
}

constexpr const char* kCubeOfQuads =
    "# a cube\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Files {
    TemporaryFolder folder;
    [[nodiscard]] std::filesystem::path put(const std::string& name, const std::string& text) const {
        std::ofstream(folder.path() / name, std::ios::binary) << text;
        return folder.path() / name;
    }
    // NOLINTNEXTLINE(modernize-use-nodiscard): it checks, too
    std::string refusal(const std::string& name, const std::string& text) const {
        const auto mesh = io::read_mesh(put(name, text));
        REQUIRE_FALSE(mesh);
        CHECK(mesh.error().message().find(name) != std::string::npos);
        return mesh.error().message();
    }
};

} // namespace

TEST_CASE("what ramus writes it reads, closed and welded, in every format") {
    const Files files;
    mesh::TriangleMesh ball = test::icosphere(3, {5, 6, 7}, 3.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    for (const char* name : {"ball.ply", "ball.stl", "ball.obj", "BALL.STL"}) {
        CAPTURE(name);
        REQUIRE(io::write_mesh(ball, files.folder.path() / name));
        const auto mesh = io::read_mesh(files.folder.path() / name);
        REQUIRE_MESSAGE(mesh, (mesh ? "" : mesh.error().message()));
        CHECK(mesh->positions.size() == ball.positions.size());
        CHECK(mesh->triangles.size() == ball.triangles.size());
        CHECK(enclosed(*mesh) == doctest::Approx(enclosed(ball)).epsilon(1e-4));
        for (std::size_t v = 0; v < mesh->positions.size(); ++v)
            CHECK(glm::dot(mesh->normals[v], (mesh->positions[v] - glm::vec3(5, 6, 7)) / 3.0F) > 0.99F);
    }
}

TEST_CASE("text formats, quads and meshes turned inside out are read as well") {
    const Files files;
    mesh::TriangleMesh cube = test::cube(2.0);
    for (const auto& file : {std::pair{"cube.stl", text_stl(cube)}, std::pair{"cube.ply", text_ply(cube)},
                             std::pair{"cube.obj", std::string(kCubeOfQuads)}}) {
        const auto& name = file.first;
        CAPTURE(name);
        const auto mesh = io::read_mesh(files.put(name, file.second));
        REQUIRE_MESSAGE(mesh, (mesh ? "" : mesh.error().message()));
        CHECK(mesh->positions.size() == 8);
        CHECK(mesh->triangles.size() == 12);
        CHECK(enclosed(*mesh) == doctest::Approx(8.0));
    }
    for (glm::uvec3& t : cube.triangles) std::swap(t.x, t.y);
    CHECK(enclosed(*io::read_mesh(files.put("in.stl", text_stl(cube)))) == doctest::Approx(8.0));
    std::swap(cube.triangles[3].x, cube.triangles[3].y); // and one as it was
    std::swap(cube.triangles[7].x, cube.triangles[7].y);
    CHECK(enclosed(*io::read_mesh(files.put("mixed.stl", text_stl(cube)))) == doctest::Approx(8.0));
}

TEST_CASE("polygons with dents are cut inside") {
    // An L of area 3, in a slanted plane, from every corner, either way round.
    const std::vector<glm::dvec2> flat{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (std::size_t start = 0; start < flat.size(); ++start)
        for (const bool backwards : {false, true}) {
            std::vector<glm::dvec3> corners;
            for (std::size_t i = 0; i < flat.size(); ++i) {
                const glm::dvec2 p = flat[(start + (backwards ? flat.size() - i : i)) % flat.size()];
                corners.emplace_back(p.x, 0.6 * p.y, 0.8 * p.y);
            }
            double area = 0.0;
            const auto triangles = mesh::cut_polygon(corners);
            CHECK(triangles.size() == 4);
            for (const glm::uvec3& t : triangles) {
                const glm::dvec3 n = glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]);
                CHECK(glm::dot(n, {0.0, -0.8, 0.6}) * (backwards ? -1.0 : 1.0) > 0.0);
                area += 0.5 * glm::length(n);
            }
            CHECK(area == doctest::Approx(3.0));
        }
    CHECK(mesh::cut_polygon(std::vector<glm::dvec3>(2)).empty());
}

TEST_CASE("a surface with holes is refused, with where they are") {
    const Files files;
    mesh::TriangleMesh cube = test::cube(2.0);
    cube.triangles.resize(11);
    const std::string message = files.refusal("open.stl", text_stl(cube));
    CHECK(message.find("not closed") != std::string::npos);
    CHECK(message.find("3 edges") != std::string::npos);
    mesh::TriangleMesh fan = test::cube(2.0);
    fan.positions.push_back({0, 0, 9}); // two flaps on one edge
    fan.triangles.push_back({0, 1, 8});
    fan.triangles.push_back({1, 0, 8});
    CHECK(files.refusal("fan.ply", text_ply(fan)).find("not closed") != std::string::npos);
}

TEST_CASE("a surface with one side has no inside") {
    // Six vertices: the projective plane, every edge with two triangles.
    mesh::TriangleMesh plane;
    for (int i = 0; i < 6; ++i) plane.positions.push_back({float(i), float(i * i), float(i * i * i)});
    for (const glm::uvec3& t :
         {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 4), glm::uvec3(0, 4, 5), glm::uvec3(0, 5, 1),
          glm::uvec3(1, 2, 4), glm::uvec3(2, 3, 5), glm::uvec3(3, 4, 1), glm::uvec3(4, 5, 2), glm::uvec3(5, 1, 3)})
        plane.triangles.push_back(t);
    const auto closed = mesh::closed_mesh(plane, "plane");
    REQUIRE_FALSE(closed);
    CHECK(closed.error().message().find("one side") != std::string::npos);
}

TEST_CASE("what is no mesh is refused by name") {
    const Files files;
    CHECK_FALSE(io::read_mesh(files.folder.path() / "missing.stl"));
    CHECK_FALSE(io::read_mesh(files.folder.path()));
    CHECK(files.refusal("mesh.xyz", "x").find(io::readable_mesh_extensions()) != std::string::npos);
    CHECK(files.refusal("empty.stl", "").find("empty") != std::string::npos);
    files.refusal("words.stl", "solid and nothing else");
    files.refusal("words.ply", "ply\nformat ascii 1.0\nend_header\n");
    files.refusal("words.obj", "v 1 2\nf 1 2 3\n");
    files.refusal("points.obj", "v 1 2 3\nv 2 3 4\nv 3 4 5\n");
    files.refusal("far.obj", "v 1e30 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
    files.refusal("index.obj", "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 999999999\nf -9 1 2\n");
    files.refusal("many.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 4000000000\n"
                              "property list uchar int vertex_indices\nend_header\n");
}

TEST_CASE("a mesh that declares a billion triangles and holds two takes no memory") {
    const Files files;
    const std::string two(std::size_t{2} * 50, '\0');
    const test::PeakMemory memory;
    files.refusal("lie.stl", std::string(80, ' ') + std::string("\x00\xca\x9a\x3b", 4) + two);
    files.refusal("lie.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 1000000000\n"
                             "property list uchar int vertex_indices\nend_header\n" +
                                 two);
    files.refusal("lie.obj", "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 1000000000\n");
    CHECK(memory.grown_mib() < 30.0);
}

TEST_CASE("a real mesh that is cut short gives a clear error" * doctest::test_suite("slow")) {
    const auto path = test::shared_file("surfaces", "carotid_lumen.stl");
    if (!path) return;
    std::ifstream file(*path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const Files files;
    CHECK(io::read_mesh(*path, io::Holes::kAllowed));
    for (std::size_t part = 0; part < 20; ++part) {
        CAPTURE(part);
        const auto mesh = io::read_mesh(files.put("cut.stl", whole.substr(0, whole.size() * part / 20)));
        REQUIRE_FALSE(mesh);
        CHECK(mesh.error().where.find("cut.stl") != std::string::npos);
        CHECK_FALSE(mesh.error().hint.empty());
    }
}

TEST_CASE("a mesh file leads to no other file") {
    const Files files;
    // Whoever opens a pipe that nobody writes to waits for ever.
    REQUIRE(::mkfifo((files.folder.path() / "pipe").c_str(), 0600) == 0);
    const std::string lines = "mtllib pipe\nmtllib $$$___magic___$$$.obj\nusemtl a\nmap_Kd pipe\n# \\\nmtllib pipe\n";
    const auto plain = io::read_mesh(files.put("plain.obj", kCubeOfQuads));
    const auto with_lines = io::read_mesh(files.put("lines.obj", lines + kCubeOfQuads + "\x0cmtllib pipe\n" + lines));
    REQUIRE(plain);
    REQUIRE(with_lines);
    CHECK(with_lines->positions == plain->positions);
    CHECK(with_lines->triangles == plain->triangles);
    std::string ply = text_ply(*plain);
    ply.insert(ply.find("element"), "comment TextureFile pipe\n");
    CHECK(io::read_mesh(files.put("texture.ply", ply)));
}

TEST_CASE("of an OBJ file only the lines of its shape are looked at") {
    CHECK(io::obj_shape("mtllib a\n v 1 2 3\rusemtl b\r\nf 1 2 3\nvn 0 0 1\nvt 0 0\nvp 1\no v\n") ==
          " v 1 2 3\nf 1 2 3\nvn 0 0 1\nvt 0 0\n");
    CHECK(io::obj_shape("f 1 2 \\\r\n3 4\nv 1 2 3 \\\nmtllib a") == "f 1 2    3 4\nv 1 2 3   mtllib a\n");
}

TEST_CASE("damaged files end in an answer" * doctest::test_suite("slow")) {
    const Files files;
    mesh::TriangleMesh ball = test::icosphere(1, {0, 0, 0}, 3.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    std::mt19937 random(1);
    for (const char* name : {"ball.ply", "ball.stl", "ball.obj", "text.stl", "text.ply"}) {
        std::string whole;
        if (std::string(name).starts_with("ball")) {
            REQUIRE(io::write_mesh(ball, files.folder.path() / name));
            whole = files.folder.text(name);
        } else {
            whole = std::string(name).ends_with("stl") ? text_stl(ball) : text_ply(ball);
        }
        for (int round = 0; round < 300; ++round) {
            std::string text = whole;
            if (round % 3 == 0) text.resize(random() % text.size());
            for (unsigned i = 0; i < random() % 6; ++i)
                if (!text.empty())
                    text[(round % 2 == 0 ? random() % std::min<std::size_t>(400, text.size())
                                         : random() % text.size())] = static_cast<char>(random());
            const auto mesh = io::read_mesh(files.put(name, text));
            if (mesh) CHECK(mesh->triangles.size() > 3);
        }
    }
}
