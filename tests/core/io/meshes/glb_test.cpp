// GLB as assimp reads it, which knows nothing of the writer.
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/mesh_sections.h"
#include "tests/support/icosphere.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <cmath>
#include <doctest/doctest.h>
#include <map>
#include <set>

using namespace ramus;

namespace {

// A ball that belongs to four branches by the quarter of its equator, and another one that is a fifth.
mesh::TriangleMesh five_branches() {
    mesh::TriangleMesh mesh = test::icosphere(3, {10, 20, 30}, 4.0);
    const mesh::TriangleMesh other = test::icosphere(1, {-10, 0, 0}, 2.0);
    for (const glm::vec3& p : mesh.positions) mesh.branches.push_back((p.x > 10.0F ? 1 : 0) + (p.y > 20.0F ? 2 : 0));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
    mesh.branches.resize(mesh.positions.size(), 4);
    mesh.radii.resize(mesh.positions.size(), 4.0F);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.normals.push_back(v < first ? (mesh.positions[v] - glm::vec3(10, 20, 30)) / 4.0F
                                         : (mesh.positions[v] - glm::vec3(-10, 0, 0)) / 2.0F);
    return mesh;
}

// Branches 0 to 3 are one system, 4 another.
io::MeshNames names_of_five(io::PartsBy by) {
    io::MeshNames names;
    names.name = "five";
    names.by = by;
    names.systems = {{"portal vein", {0, 128, 255}}, {"artery \"A\" \\ \xC3\xA4", {255, 0, 0}}};
    for (int b = 0; b < 5; ++b)
        names.branches.push_back({"branch " + std::to_string(b), names.systems[b == 4].colour, b == 4 ? 1 : 0});
    return names;
}

struct Read {
    Assimp::Importer importer;
    const aiScene* scene = nullptr;
    explicit Read(const std::filesystem::path& file) : scene(importer.ReadFile(file.string(), 0)) {
        REQUIRE_MESSAGE(scene != nullptr, importer.GetErrorString());
    }
};

void collect(const aiNode& node, std::multiset<std::string>& names) {
    names.insert(node.mName.C_Str());
    for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], names);
}

// What is in the scene in the unit and the axes of glTF: all triangles as corners.
void collect(const aiScene& scene, const aiNode& node, aiMatrix4x4 to_scene, std::vector<aiVector3D>& corners) {
    to_scene *= node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
        for (unsigned f = 0; f < part.mNumFaces; ++f)
            for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k)
                corners.push_back(to_scene * part.mVertices[part.mFaces[f].mIndices[k]]);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) collect(scene, *node.mChildren[i], to_scene, corners);
}

} // namespace

TEST_CASE("GLB has a node for each branch below its system, with name and colour") {
    const TemporaryFolder folder;
    REQUIRE(io::write_mesh(five_branches(), folder.path() / "b.glb", names_of_five(io::PartsBy::kBranch)));
    const Read read(folder.path() / "b.glb");
    std::multiset<std::string> names;
    collect(*read.scene->mRootNode, names);
    for (const char* name : {"branch 0", "branch 1", "branch 2", "branch 3", "branch 4", "portal vein", "five",
                             "artery \"A\" \\ \xC3\xA4"})
        CHECK(names.count(name) == 1);
    CHECK(read.scene->mNumMeshes == 5);
    const aiNode* system = read.scene->mRootNode->FindNode("portal vein");
    REQUIRE(system != nullptr);
    CHECK(system->mNumChildren == 4);
    CHECK(read.scene->mRootNode->FindNode("branch 4")->mParent->mName == aiString("artery \"A\" \\ \xC3\xA4"));
    // Colours are linear: 128 of sRGB is 0.2158 (IEC 61966-2-1).
    const aiMesh& first = *read.scene->mMeshes[system->mChildren[0]->mMeshes[0]];
    aiColor4D colour;
    REQUIRE(read.scene->mMaterials[first.mMaterialIndex]->Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS);
    CHECK(colour.r == 0.0F);
    CHECK(colour.g == doctest::Approx(0.2158605).epsilon(1e-5));
    CHECK(colour.b == 1.0F);
    CHECK(read.scene->mMaterials[first.mMaterialIndex]->GetName() == aiString("portal vein"));
}

TEST_CASE("GLB has a node for each system, or one for the whole") {
    const TemporaryFolder folder;
    const mesh::TriangleMesh mesh = five_branches();
    REQUIRE(io::write_mesh(mesh, folder.path() / "s.glb", names_of_five(io::PartsBy::kSystem)));
    const Read systems(folder.path() / "s.glb");
    CHECK(systems.scene->mNumMeshes == 2);
    CHECK(systems.scene->mRootNode->FindNode("portal vein")->mNumMeshes == 1);
    REQUIRE(io::write_mesh(mesh, folder.path() / "n.glb", names_of_five(io::PartsBy::kNone)));
    const Read whole(folder.path() / "n.glb");
    REQUIRE(whole.scene->mNumMeshes == 1);
    CHECK(whole.scene->mMeshes[0]->mNumVertices == mesh.positions.size());
    CHECK(whole.scene->mMeshes[0]->mNumFaces == mesh.triangles.size());
    // What a mesh has none of is not divided by it.
    mesh::TriangleMesh of_mask = mesh;
    of_mask.branches.clear();
    of_mask.radii.clear();
    REQUIRE(io::write_mesh(of_mask, folder.path() / "m.glb", names_of_five(io::PartsBy::kBranch)));
    CHECK(Read(folder.path() / "m.glb").scene->mNumMeshes == 1);
    REQUIRE(io::write_mesh(mesh, folder.path() / "u.glb"));
    CHECK(Read(folder.path() / "u.glb").scene->mNumMeshes == 1);
}

TEST_CASE("GLB is in metres with +Y up and the patient's front toward +Z, and loses no triangle") {
    const TemporaryFolder folder;
    const mesh::TriangleMesh mesh = five_branches();
    using Corner = std::tuple<float, float, float>;
    const auto sorted = [](auto corners) {
        std::ranges::sort(corners);
        return corners;
    };
    for (const io::PartsBy by : {io::PartsBy::kNone, io::PartsBy::kSystem, io::PartsBy::kBranch}) {
        REQUIRE(io::write_mesh(mesh, folder.path() / "g.glb", names_of_five(by)));
        const Read read(folder.path() / "g.glb");
        std::vector<aiVector3D> corners;
        collect(*read.scene, *read.scene->mRootNode, {}, corners);
        std::vector<Corner> found, expected;
        const auto rounded = [](double metres) { return static_cast<float>(std::round(1e6 * metres)); };
        for (const aiVector3D& p : corners) found.emplace_back(rounded(p.x), rounded(p.y), rounded(p.z));
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                // Right of RAS is -X of glTF, front is +Z, up is +Y.
                const glm::vec3& p = mesh.positions[t[k]];
                expected.emplace_back(rounded(-1e-3 * p.x), rounded(1e-3 * p.z), rounded(1e-3 * p.y));
            }
        REQUIRE(found.size() == expected.size());
        found = sorted(std::move(found));
        expected = sorted(std::move(expected));
        std::size_t far = 0; // by more than a thousandth of a mm
        for (std::size_t i = 0; i < found.size(); ++i)
            far += std::abs(std::get<0>(found[i]) - std::get<0>(expected[i])) > 1.0F ? 1 : 0;
        CHECK(far == 0);
    }
}

TEST_CASE("sections have vertices of their own, and all triangles turned as they were") {
    const mesh::TriangleMesh mesh = five_branches();
    const auto section_of = [&](const glm::uvec3& t) {
        return static_cast<std::size_t>(io::branch_of(t, mesh.branches));
    };
    const io::MeshSections cut = io::sections_of(mesh, 7, section_of); // the last two stay empty
    std::map<std::size_t, std::vector<glm::uvec3>> expected;
    for (const glm::uvec3& t : mesh.triangles) expected[section_of(t)].push_back(t);
    std::size_t vertices = 0;
    for (std::size_t s = 0; s < cut.sections.size(); ++s) {
        const auto& section = cut.sections[s];
        REQUIRE(section.triangles == expected[s].size());
        CHECK(section.first_vertex == (section.triangles > 0 ? vertices : 0));
        std::set<std::uint32_t> used;
        for (std::size_t t = 0; t < section.triangles; ++t)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t local = cut.triangles[section.first_triangle + t][k];
                REQUIRE(local < section.vertices);
                const std::uint32_t vertex = cut.vertices[section.first_vertex + local];
                CHECK(vertex == expected[s][t][k]);
                used.insert(vertex);
                for (int axis = 0; axis < 3; ++axis) {
                    CHECK(section.least[axis] <= mesh.positions[vertex][axis]);
                    CHECK(section.most[axis] >= mesh.positions[vertex][axis]);
                }
            }
        CHECK(used.size() == section.vertices); // each is used, none is twice there
        vertices += section.vertices;
    }
    CHECK(vertices == cut.vertices.size());
}

TEST_CASE("a triangle belongs to the branch of two of its corners") {
    const std::vector<std::int32_t> branches = {7, 7, 9, 11};
    CHECK(io::branch_of({0, 1, 2}, branches) == 7);
    CHECK(io::branch_of({2, 0, 1}, branches) == 7);
    CHECK(io::branch_of({0, 2, 1}, branches) == 7);
    CHECK(io::branch_of({2, 0, 3}, branches) == 9);
}
