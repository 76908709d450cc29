#include "core/io/meshes/stl.h"

#include "core/io/meshes/assimp_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

namespace ramus::io {

namespace {

constexpr std::size_t kStlHeader = 80; // bytes

} // namespace

bool is_stl(std::string_view head) {
    if (head.starts_with("solid") && head.find("facet") != std::string_view::npos) return true;
    constexpr std::size_t kFacet = 50;
    std::uint32_t count = 0;
    if (head.size() < kStlHeader + sizeof count + kFacet) return false;
    std::memcpy(&count, head.data() + kStlHeader, sizeof count);
    const std::string_view facets = head.substr(kStlHeader + sizeof count);
    for (std::size_t n = 0; n < std::min<std::size_t>(count, facets.size() / kFacet); ++n) {
        std::array<float, 12> numbers{}; // a normal, and the three corners
        std::memcpy(numbers.data(), facets.data() + n * kFacet, sizeof numbers);
        if (!std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); })) return false;
        const float length = std::hypot(numbers[0], numbers[1], numbers[2]);
        if (length != 0.0F && std::abs(length - 1.0F) > 0.01F) return false;
    }
    return count > 0;
}

Result<PolygonSoup> parse_stl(std::string_view text, const std::string& name) {
    auto soup = parse_with_assimp(text, "stl", name);
    // A text may have a longer line; binary files may begin like text.
    const std::size_t line = std::min(text.substr(0, kHeadBytes).find('\n'), text.size());
    if (soup) soup->orientation = space_in(text.substr(0, text.starts_with("solid") ? line : kStlHeader));
    return soup;
}

std::string stl_header(const MeshCounts& counts) {
    // A binary file must not begin with "solid", or programs take it for text.
    std::string header = "ramus " RAMUS_VERSION ", " + counts.claims_text();
    header.resize(kStlHeader, ' ');
    const auto count = static_cast<std::uint32_t>(counts.triangles);
    header.append(reinterpret_cast<const char*>(&count), sizeof count);
    return header;
}

void write_stl_facets(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file) {
    for (const glm::uvec3& t : triangles) {
        const glm::vec3 &a = vertices.positions[t.x], &b = vertices.positions[t.y], &c = vertices.positions[t.z];
        // In double precision, because the square of a small triangle's area underflows in single precision.
        const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double length = glm::length(across);
        file.write_value(std::array{length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F), a, b, c});
        file.write_value(std::uint16_t{0});
    }
}

} // namespace ramus::io
