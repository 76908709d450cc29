#include "core/io/meshes/assimp_reader.h"

#include "core/base/own_process.h"
#include "core/io/binary_numbers.h"
#include "core/io/input_file.h"

#include <algorithm>
#include <assimp/BaseImporter.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <optional>

namespace ramus::io {

namespace {

// Gives the library no access to files. It reads from memory and opens no materials or images.
class NoFiles final : public Assimp::IOSystem {
public:
    [[nodiscard]] bool Exists(const char* /*file*/) const override { return false; }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* /*file*/, const char* /*mode*/) override { return nullptr; }
    void Close(Assimp::IOStream* /*stream*/) override {}
};

// Only the reader of this format: another reader would accept a file of another format.
bool keep_only(Assimp::Importer& importer, const std::string& extension) {
    bool found = false;
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        std::vector<std::string_view> known;
        split_words(about != nullptr ? about->mFileExtensions : "", " ", known);
        if (std::ranges::find(known, extension) != known.end()) {
            found = true;
        } else { // which leaves it to the caller
            const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
            importer.UnregisterLoader(other.get());
        }
    }
    return found;
}

// The answer of the process, binary: the number of positions, the positions, and for each polygon the number of its
// corners and their indices. Empty: the file is damaged.
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max(); // an invalid corner

template <class T> void append_numbers(std::string& bytes, const std::vector<T>& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

struct SoupNumbers {
    std::vector<double> positions;
    std::vector<std::uint32_t> polygons;
};

// `place`: from the axes of the mesh to those of the scene.
void add_part(const aiMesh& part, const aiMatrix4x4t<double>& place, SoupNumbers& numbers) {
    const auto first = static_cast<std::uint32_t>(numbers.positions.size() / 3);
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
        const aiVector3t<double> at =
            place * aiVector3t<double>(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
        numbers.positions.insert(numbers.positions.end(), {at.x, at.y, at.z});
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        numbers.polygons.push_back(face.mNumIndices);
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            numbers.polygons.push_back(face.mIndices[k] < part.mNumVertices ? first + face.mIndices[k] : kNoVertex);
    }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4t<double>& above, SoupNumbers& numbers) {
    const aiMatrix4x4t<double> place = above * aiMatrix4x4t<double>(node.mTransformation);
    for (unsigned m = 0; m < node.mNumMeshes; ++m) add_part(*scene.mMeshes[node.mMeshes[m]], place, numbers);
    for (unsigned n = 0; n < node.mNumChildren; ++n) add_node(scene, *node.mChildren[n], place, numbers);
}

std::string soup_bytes(const aiScene& scene) {
    SoupNumbers numbers;
    if (scene.mRootNode != nullptr) add_node(scene, *scene.mRootNode, {}, numbers);
    std::string bytes;
    append_numbers(bytes, std::vector<std::uint64_t>{numbers.positions.size() / 3});
    append_numbers(bytes, numbers.positions);
    append_numbers(bytes, numbers.polygons);
    return bytes;
}

// Detects that the library leaves triangles out, which it reports only in its log.
class LeftOut final : public Assimp::LogStream {
public:
    explicit LeftOut(bool& any) : any_(any) {}
    void write(const char* message) override {
        any_ = any_ || std::string_view(message).find("out-of-range") != std::string_view::npos;
    }

private:
    bool& any_;
};

// `input`: the format's extension, a line feed, and the bytes of the file.
std::string read_with_assimp(std::string_view input) {
    const std::size_t line = input.find('\n');
    const std::string extension(input.substr(0, line));
    const std::string_view text = input.substr(line + 1);
    try {
        bool left_out = false; // the library has one logger for each process, and this process runs it once
        Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
        Assimp::DefaultLogger::get()->attachStream(new LeftOut(left_out), Assimp::Logger::Warn); // which owns it
        Assimp::Importer importer;
        importer.SetIOHandler(new NoFiles); // which owns it
        if (!keep_only(importer, extension)) return {};
        const aiScene* scene = importer.ReadFileFromMemory(text.data(), text.size(), 0, extension.c_str());
        return scene == nullptr || left_out ? std::string() : soup_bytes(*scene);
    } catch (const std::exception&) { // on damaged files
        return {};
    }
}

// The inverse of soup_bytes(). None: the bytes are invalid.
std::optional<PolygonSoup> soup_of(std::string_view bytes) {
    const auto count = take_number<std::uint64_t>(bytes);
    if (!count || *count > bytes.size() / sizeof(glm::dvec3)) return std::nullopt;
    PolygonSoup soup;
    soup.positions.resize(*count);
    if (*count > 0) std::memcpy(soup.positions.data(), bytes.data(), *count * sizeof(glm::dvec3));
    bytes.remove_prefix(*count * sizeof(glm::dvec3));
    while (!bytes.empty()) {
        const auto corners = take_number<std::uint32_t>(bytes);
        if (!corners || *corners > bytes.size() / sizeof(std::uint32_t)) return std::nullopt;
        std::vector<std::uint32_t> polygon(*corners);
        if (*corners > 0) std::memcpy(polygon.data(), bytes.data(), polygon.size() * sizeof(std::uint32_t));
        bytes.remove_prefix(polygon.size() * sizeof(std::uint32_t));
        soup.polygons.push_back(std::move(polygon));
    }
    return soup;
}

} // namespace

// The library's post-processing trusts the numbers in the file, so none is used. Reading itself crashes on some damaged
// files, so it runs in a separate process.
Result<PolygonSoup> parse_with_assimp(std::string_view text, const std::string& extension, const std::string& name) {
    constexpr std::uint64_t kMostGrowth = 64; // memory for each byte of text: the library keeps objects for short lines
    ProcessLimits limits;
    limits.memory += kMostGrowth * text.size();
    limits.answer += kMostGrowth * text.size();
    const auto answer = run_in_own_process(read_with_assimp, (extension + '\n').append(text), limits);
    auto soup = answer ? soup_of(*answer) : std::nullopt;
    if (!soup) return fail("this is no ." + extension + " mesh, or it is damaged", name, "write it again");
    for (const auto& polygon : soup->polygons)
        if (std::ranges::any_of(polygon, [&](std::uint32_t corner) { return corner >= soup->positions.size(); }))
            return fail("a triangle names a vertex that is not there", name, "write the file again");
    return std::move(*soup);
}

} // namespace ramus::io
