// NearDivision: subdivides triangles of a surface near the eye until their edges no longer look straight.
//
// An edge is divided where the surface visibly bends away from it, and where one vessel's surface continues into
// another's. If the mesh knows its exact surface (field::SurfaceProjector) and edges are longer than some pixels, old
// and new vertices are moved onto that surface; otherwise edges bend by the normals at their ends (bent_edge.h). Walls,
// and the rim that an obstacle cuts, stay as in the mesh. Each edge is decided once for all triangles that share it, so
// no gaps open.
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

// Classification of a vertex by its surroundings.
enum class NearPlace : std::uint8_t {
    kSmooth,  // not next to a contact
    kOwn,     // next to a contact, on the vessel's own surface
    kCovered, // next to a contact, inside another vessel
    kWall,    // on a wall between vessels, or on the cut of an obstacle
    kCrease,  // judged by the mesh, if its exact surface is unknown
};

class NearDivision {
public:
    // `most_off`: largest error of an edge's middle, in pixels. References must outlive the object.
    NearDivision(const PagedMesh& mesh, const NearView& view, float most_off)
        : mesh_(mesh), view_(view), most_off_(most_off) {}

    // Whether a page may have an edge to divide.
    [[nodiscard]] bool concerns(const TrianglePage& page) const;
    // Divides the triangles of `pages`; `shown`: all pages in the picture; both ascending. False: the result would have
    // more than `most` triangles, and nothing is produced.
    [[nodiscard]] bool divide(const std::vector<std::size_t>& pages, const std::vector<std::size_t>& shown,
                              std::size_t most);

    std::vector<std::size_t> replaced; // pages that `made` replaces completely
    mesh::TriangleMesh made;
    std::vector<float> values; // by vertex of `made`; empty if the mesh has none

private:
    struct Vertex {
        EdgeEnd end{};
        EdgeOwner owner{};
        float value = 0.0F;
        float edge = 0.0F; // the longest edge of the mesh around it, mm
        NearPlace place = NearPlace::kSmooth;
        bool exact = false; // evaluated on the exact surface
    };
    struct Triangle {
        glm::uvec3 corners;
        std::uint32_t page = 0;   // index into the pages given
        std::uint8_t settled = 0; // a bit for each edge that needs no division
    };
    struct Edge {
        std::uint32_t a = 0, b = 0; // a < b
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
    std::vector<std::uint8_t> changed_; // by index into the pages given
};

} // namespace ramus::render
