#include "core/io/mesh_encoding.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::io {

tl::unexpected<Error> too_many_for_file(const std::string& path) {
    return fail("the mesh has more triangles than its format can count", path, "use a lower --detail");
}

std::string ply_header(VertexArrays arrays, std::uint64_t vertices, std::uint64_t triangles) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment ramus " RAMUS_VERSION ", mm, RAS\n"
                         "element vertex " +
                         std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n";
    if (arrays.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
    if (arrays.radii) header += "property float radius\n";
    if (arrays.branches) header += "property int branch\n";
    header += "element face " + std::to_string(triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
    return header;
}

std::string stl_header(std::uint64_t triangles) {
    // A binary file must not begin with "solid", or programs take it for text.
    std::string header = "ramus " RAMUS_VERSION ", mm, RAS";
    header.resize(80, ' ');
    const auto count = static_cast<std::uint32_t>(triangles);
    header.append(reinterpret_cast<const char*>(&count), sizeof count);
    return header;
}

Record<kStlFacet> stl_facet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Record<kStlFacet> facet;
    // In double precision: the square of a small triangle's area leaves single precision.
    const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double length = glm::length(across);
    facet.put(length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F));
    facet.put(a);
    facet.put(b);
    facet.put(c);
    facet.put(std::uint16_t{0});
    return facet;
}

std::string_view obj_header() { return "# ramus " RAMUS_VERSION ", mm, RAS\n"; }

void ObjLines::vector(std::string_view name, const glm::vec3& vector) {
    text(name);
    for (int axis = 0; axis < 3; ++axis) {
        text(" ");
        number(vector[axis]);
    }
    end();
}

void ObjLines::face(const glm::uvec3& triangle, bool with_normals) {
    text("f");
    for (int corner = 0; corner < 3; ++corner) {
        const std::uint64_t index = std::uint64_t{triangle[corner]} + 1;
        text(" ");
        number(index);
        if (!with_normals) continue;
        text("//");
        number(index);
    }
    end();
}

void ObjLines::text(std::string_view word) { next_ = std::ranges::copy(word, next_).out; }

void ObjLines::end() {
    *next_++ = '\n';
    file_.write(bytes_.data(), static_cast<std::size_t>(next_ - bytes_.data()));
    next_ = bytes_.data();
}

} // namespace ramus::io
