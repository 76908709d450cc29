// NearDivision: divides triangles of a surface until no picture shows their edges to be straight.
//
// An edge is divided where the surface bends away from it so far that one sees it, and where a vessel's surface goes on
// into another vessel. Where the mesh knows what it is a mesh of (field::SurfaceProjector) and edges are longer than
// some pixels, vertices are moved onto that, new ones and those of the mesh; else edges bend as the normals at their
// ends say (bent_edge.h). Walls, and the edge of what an obstacle cuts off, stay as the mesh has them. Whether and
// where an edge is divided is found once, for all triangles that share it: nothing opens between them.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "render/scene/bent_edge.h"
#include "render/scene/edge_owner.h"
#include "render/scene/near_view.h"
#include "render/scene/paged_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::render {

// What is around a vertex.
enum class NearPlace : std::uint8_t {
    kSmooth,  // beside no contact
    kOwn,     // beside one, on the vessel's own surface
    kCovered, // the same, within another vessel
    kWall,    // on a wall between vessels, or on what an obstacle cuts off
    kCrease,  // as far as the mesh tells, where nothing more is known
};

class NearDivision {
public:
    // Pixels that the middle of an edge may be off in the picture: `most_off`. What is referred to outlasts it.
    NearDivision(const PagedMesh& mesh, const NearView& view, float most_off)
        : mesh_(mesh), view_(view), most_off_(most_off) {}

    // Whether a page has an edge that may have to be divided.
    [[nodiscard]] bool concerns(const TrianglePage& page) const;
    // Divides the triangles of some of the pages that the picture shows, ascending. False: there would be more than
    // `most`, and nothing is made.
    [[nodiscard]] bool divide(const std::vector<std::size_t>& pages, const std::vector<std::size_t>& shown,
                              std::size_t most);

    std::vector<std::size_t> replaced; // pages all of whose triangles are in `made`
    mesh::TriangleMesh made;
    std::vector<float> values; // none where the mesh has none

private:
    struct Vertex {
        EdgeEnd end{};
        EdgeOwner owner{};
        float value = 0.0F;
        float edge = 0.0F; // the longest edge of the mesh around it, mm
        NearPlace place = NearPlace::kSmooth;
        bool exact = false; // the surface itself is looked at there
    };
    struct Triangle {
        glm::uvec3 corners;
        std::uint32_t page = 0;   // its place among the pages
        std::uint8_t settled = 0; // a bit for each edge that stays as it is
    };
    struct Edge {
        std::uint32_t a = 0, b = 0; // the lower first
        Vertex middle{};
        bool divided = false;
    };
    struct Side { // of a triangle
        std::uint64_t edge = 0;
        std::uint32_t triangle = 0, number = 0;
    };
    [[nodiscard]] float pixels_of(const glm::vec3& place, float length) const;
    [[nodiscard]] bool may_bend(const Vertex& a, const Vertex& b) const;
    [[nodiscard]] bool is_divided(const Vertex& a, const Vertex& b, const Vertex& middle) const;

    void take(const std::vector<std::size_t>& pages);
    void mark_creases(const std::vector<std::size_t>& shown);
    void move_vertices(const std::vector<std::size_t>& pages, const std::vector<std::size_t>& shown);
    std::vector<Edge> find_edges(std::vector<Side>& sides);
    void place_middles(std::vector<Edge>& edges) const;
    bool divide_once();
    void split(const Triangle& triangle, const glm::uvec3& middles);
    void write(const std::vector<std::size_t>& pages);

    const PagedMesh& mesh_;
    const NearView& view_;
    float most_off_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> numbers_; // by vertex of the mesh
    std::vector<Triangle> active_, next_, done_;
    std::vector<std::uint8_t> changed_; // by place among the pages
};

} // namespace ramus::render
