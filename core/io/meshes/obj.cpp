#include "core/io/meshes/obj.h"

#include "core/io/input_file.h"
#include "core/io/meshes/assimp_reader.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace ramus::io {

namespace {

void write_vectors(std::string_view name, std::span<const glm::vec3> vectors, BufferedFile& file) {
    for (const glm::vec3& vector : vectors) {
        file.write(name);
        for (int axis = 0; axis < 3; ++axis) {
            file.write(" ");
            file.write_number(vector[axis]);
        }
        file.write("\n");
    }
}

// The characters that the library treats as line ends.
constexpr std::string_view kLineEnds("\n\r\f\0", 4);

bool says_shape(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\v";
    constexpr std::array<std::string_view, 4> kShape{"v", "vt", "vn", "f"};
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    return std::ranges::find(kShape, line.substr(0, line.find_first_of(kBlanks))) != kShape.end();
}

// A line that ends with a backslash continues on the next line.
void join_continued_lines(std::string& text) {
    for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
        text[at] = ' ';
        for (std::size_t end = at + 1; end < text.size() && kLineEnds.find(text[end]) != kLineEnds.npos; ++end) {
            const bool both = text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n';
            text[end] = ' ';
            if (!both) break;
        }
    }
}

// The axes that the comments before the first vertex state.
std::optional<Orientation> obj_orientation(std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find_first_of(kLineEnds));
        if (says_shape(line)) break;
        if (const auto axes = line.starts_with('#') ? space_in(line) : std::nullopt) return axes;
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return {};
}

} // namespace

bool is_obj(std::string_view head) {
    constexpr std::array<std::string_view, 8> kBefore{"o", "g", "s", "mtllib", "usemtl", "vn", "vt", "vp"};
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < head.size();) {
        const std::size_t end = std::min(head.find_first_of("\r\n", at), head.size());
        split_words(head.substr(at, end - at), " \t\v", words);
        at = end + 1;
        if (words.empty() || words[0].starts_with('#')) continue;
        if (words[0] == "v") return words.size() > 3 && to_real(words[1]) && to_real(words[2]) && to_real(words[3]);
        if (std::ranges::find(kBefore, words[0]) == kBefore.end()) return false;
    }
    return false;
}

std::string obj_shape(std::string_view text) {
    std::string joined(text);
    join_continued_lines(joined);
    const std::string_view all = joined;
    std::string kept;
    kept.reserve(all.size() + 1);
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find_first_of(kLineEnds, at), all.size());
        if (const std::string_view line = all.substr(at, end - at); says_shape(line)) (kept += line) += '\n';
        at = end + 1;
    }
    return kept;
}

Result<PolygonSoup> parse_obj(std::string_view text, const std::string& name) {
    auto soup = parse_with_assimp(obj_shape(text), "obj", name);
    if (soup) soup->orientation = obj_orientation(text);
    return soup;
}

std::string obj_header(const MeshCounts& counts) { return "# ramus " RAMUS_VERSION ", " + counts.claims_text() + "\n"; }

void write_obj_positions(const mesh::VertexSpan& vertices, BufferedFile& file) {
    write_vectors("v", vertices.positions, file);
}

void write_obj_normals(const mesh::VertexSpan& vertices, BufferedFile& file) {
    write_vectors("vn", vertices.normals, file);
}

void write_obj_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file) {
    for (const glm::uvec3& triangle : triangles) {
        file.write("f");
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = std::uint64_t{triangle[corner]} + 1;
            file.write(" ");
            file.write_number(index);
            if (vertices.normals.empty()) continue;
            file.write("//");
            file.write_number(index);
        }
        file.write("\n");
    }
}

} // namespace ramus::io
