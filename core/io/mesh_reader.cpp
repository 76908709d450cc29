#include "core/io/mesh_reader.h"

#include "core/io/ply_reader.h"
#include "core/io/tree_reader.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/cut_polygon.h"
#include "core/tree/build_tree.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <cmath>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

namespace {

// Only the reader of that one format: others would take a file that is not what its name says.
bool keep_only(Assimp::Importer& importer, const std::string& extension) {
    bool found = false;
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string_view known = about != nullptr ? about->mFileExtensions : "";
        if (known == extension)
            found = true;
        else
            importer.UnregisterLoader(importer.GetImporter(i));
    }
    return found;
}

bool sensible(const glm::dvec3& p) {
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(p[k]) || std::abs(p[k]) > tree::kMaximumCoordinate) return false;
    return true;
}

Result<PolygonSoup> polygons_of(const aiScene& scene, const std::string& name) {
    PolygonSoup soup;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& part = *scene.mMeshes[m];
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (unsigned v = 0; v < part.mNumVertices; ++v)
            soup.positions.emplace_back(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            std::vector<std::uint32_t> polygon;
            for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k) {
                if (part.mFaces[f].mIndices[k] >= part.mNumVertices)
                    return fail("a triangle names a vertex that is not there", name, "write the file again");
                polygon.push_back(first + part.mFaces[f].mIndices[k]);
            }
            soup.polygons.push_back(std::move(polygon));
        }
    }
    return soup;
}

Result<mesh::TriangleMesh> triangles_of(const PolygonSoup& soup, const std::string& name) {
    mesh::TriangleMesh mesh;
    for (const glm::dvec3& p : soup.positions) {
        if (!sensible(p))
            return fail("a coordinate is not a number of mm that makes sense", name,
                        "check the unit and the program that wrote it");
        mesh.positions.push_back(glm::vec3(p));
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

// By assimp, whose steps after reading trust the numbers in the file: none of them is asked for.
Result<PolygonSoup> read_with_assimp(const std::string& text, const std::string& extension, const std::string& name) {
    const auto damaged = fail("this is no ." + extension + " mesh, or it is damaged", name, "write it again");
    try {
        Assimp::Importer importer;
        if (!keep_only(importer, extension)) return fail("this build reads no ." + extension + " files", name);
        const aiScene* scene = importer.ReadFileFromMemory(text.data(), text.size(), 0, extension.c_str());
        return scene == nullptr ? damaged : polygons_of(*scene, name);
    } catch (const std::exception&) { // on damaged files
        return damaged;
    }
}

} // namespace

Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes) {
    const std::string name = path.string();
    std::string extension = path.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension != "stl" && extension != "ply" && extension != "obj")
        return fail("a mesh is an .stl, .ply or .obj file", name, "convert it to one of these");
    const auto text = read_file(path, kMostMeshBytes);
    if (!text) return tl::unexpected(text.error());
    if (text->empty()) return fail("the file is empty", name, "write it again");
    // PLY is read here: damaged ones make assimp work for minutes, or worse.
    const auto soup = extension == "ply" ? parse_ply(*text, name) : read_with_assimp(*text, extension, name);
    if (!soup) return tl::unexpected(soup.error());
    auto loose = triangles_of(*soup, name);
    if (!loose) return tl::unexpected(loose.error());
    return holes == Holes::kAllowed ? mesh::tidy_mesh(std::move(*loose), name)
                                    : mesh::closed_mesh(std::move(*loose), name);
}

} // namespace ramus::io
