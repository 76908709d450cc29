#include "core/io/meshes/assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <exception>
#include <memory>

namespace ramus::io {

namespace {

// Only the reader of that one format: others would take a file that is not what its name says.
bool keep_only(Assimp::Importer& importer, const std::string& extension) {
    bool found = false;
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string_view known = about != nullptr ? about->mFileExtensions : "";
        if (known == extension) {
            found = true;
        } else { // which leaves it to the caller
            const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
            importer.UnregisterLoader(other.get());
        }
    }
    return found;
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

} // namespace

// The library's steps after reading trust the numbers in the file: none of them is asked for.
Result<PolygonSoup> parse_with_assimp(std::string_view text, const std::string& extension, const std::string& name) {
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

} // namespace ramus::io
