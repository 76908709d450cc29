#include "core/io/binary_numbers.h"
#include "core/io/meshes/assimp_reader.h"
#include "core/io/meshes/glb.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace ramus::io {

namespace {

// The JSON of the file's first chunk; empty: there is none.
std::string_view glb_description(std::string_view text) {
    constexpr std::size_t kHeaders = 20; // bytes of the file's and the chunk's
    if (text.size() < kHeaders) return {};
    return text.substr(kHeaders, number_at<std::uint32_t>(text.data() + 12, std::endian::little));
}

// Files written by ramus state the tree's axes; the transform of their top node leads to glTF's axes.
std::optional<Orientation> glb_orientation(std::string_view description) {
    if (description.find(R"("generator":"ramus)") == std::string_view::npos) return {};
    constexpr std::string_view kKey = R"("orientation":")";
    const std::size_t key = description.find(kKey);
    if (key == std::string_view::npos) return {};
    const std::string_view word = description.substr(key + kKey.size());
    return Orientation::named(word.substr(0, word.find('"'))) ? std::optional(Orientation::ras()) : std::nullopt;
}

} // namespace

bool is_glb(std::string_view head) { return head.starts_with("glTF"); }

Result<PolygonSoup> parse_glb(std::string_view text, const std::string& name) {
    const std::string_view description = glb_description(text);
    for (const std::string_view compression : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
        if (description.find(compression) != std::string_view::npos)
            return fail("its triangles are compressed by " + std::string(compression), name,
                        "export it without compression");
    RAMUS_TRY(soup, parse_with_assimp(text, "glb", name));
    if (soup.polygons.empty()) return fail("there are no triangles in it", name, "export a surface");
    for (glm::dvec3& p : soup.positions) p = 1000.0 * glm::dvec3(-p.x, p.z, p.y); // from metres with +Y up
    soup.orientation = glb_orientation(description);
    return std::move(soup);
}

} // namespace ramus::io
