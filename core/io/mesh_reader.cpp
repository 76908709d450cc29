#include "core/io/mesh_reader.h"

#include "core/io/tree_reader.h"
#include "core/mesh/close_mesh.h"
#include "core/tree/build_tree.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <charconv>
#include <cmath>
#include <exception>
#include <string>
#include <string_view>

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

// A header that promises more than the file holds would make the reader ask for all the memory that it promises.
bool promises_too_much(const std::string& text, const std::string& extension) {
    if (extension != "ply") return false;
    const std::size_t end = text.find("end_header");
    std::string_view header(text.data(), end == std::string::npos ? 0 : end);
    constexpr std::string_view kElement = "element ";
    for (std::size_t at = header.find(kElement); at != std::string_view::npos; at = header.find(kElement, at + 1)) {
        std::string_view line = header.substr(at, header.find_first_of("\r\n", at) - at);
        const std::size_t digits = line.find_last_of(' ') + 1;
        std::uint64_t count = 0;
        const auto [stop, error] = std::from_chars(line.data() + digits, line.data() + line.size(), count);
        if (error != std::errc{} || stop != line.data() + line.size() || count > text.size()) return true;
    }
    return false;
}

Result<mesh::TriangleMesh> triangles_of(const aiScene& scene, const std::string& name) {
    mesh::TriangleMesh mesh;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& part = *scene.mMeshes[m];
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (unsigned v = 0; v < part.mNumVertices; ++v) {
            const aiVector3D& p = part.mVertices[v];
            for (const ai_real x : {p.x, p.y, p.z})
                if (!std::isfinite(x) || std::abs(x) > tree::kMaximumCoordinate)
                    return fail("a coordinate is not a number of mm that makes sense", name,
                                "check the unit and the program that wrote it");
            mesh.positions.push_back({p.x, p.y, p.z});
        }
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            const aiFace& face = part.mFaces[f];
            if (face.mNumIndices != 3) continue; // points and lines
            glm::uvec3 triangle;
            for (unsigned k = 0; k < 3; ++k) {
                if (face.mIndices[k] >= part.mNumVertices)
                    return fail("a triangle names a vertex that is not there", name, "write the file again");
                triangle[static_cast<int>(k)] = first + face.mIndices[k];
            }
            mesh.triangles.push_back(triangle);
        }
    }
    return mesh;
}

} // namespace

Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::string extension = path.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension != "stl" && extension != "ply" && extension != "obj")
        return fail("a lesion's mesh is an .stl, .ply or .obj file", name, "convert it to one of these");
    const auto text = read_file(path, kMostMeshBytes);
    if (!text) return tl::unexpected(text.error());
    if (text->empty()) return fail("the file is empty", name, "write it again");
    if (promises_too_much(*text, extension))
        return fail("the file is damaged: it names more than it holds", name, "write it again");
    try {
        Assimp::Importer importer;
        if (!keep_only(importer, extension)) return fail("this build reads no ." + extension + " files", name);
        const aiScene* scene =
            importer.ReadFileFromMemory(text->data(), text->size(), aiProcess_Triangulate, extension.c_str());
        if (scene == nullptr)
            return fail("this is no ." + extension + " mesh, or it is damaged", name, "write it again");
        auto loose = triangles_of(*scene, name);
        if (!loose) return tl::unexpected(loose.error());
        return mesh::closed_mesh(std::move(*loose), name);
    } catch (const std::exception&) { // of the library, on damaged files
        return fail("this is no ." + extension + " mesh, or it is damaged", name, "write it again");
    }
}

} // namespace ramus::io
