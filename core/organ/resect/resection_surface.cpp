#include "core/organ/resect/resection_surface.h"

#include "core/mesh/vertex_normals.h"
#include "core/organ/resect/box_share.h"
#include "core/volume/cell_table.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <unordered_map>
#include <utility>

namespace ramus::organ {

namespace {

// The number of a corner of the voxels' boxes. The lowest corner of a voxel has the voxel's indices.
std::uint64_t corner_number(const Organ& organ, const glm::ivec3& corner) {
    const glm::ivec3 size = organ.size() + 1;
    return static_cast<std::uint64_t>(corner.x) +
           static_cast<std::uint64_t>(size.x) *
               (static_cast<std::uint64_t>(corner.y) +
                static_cast<std::uint64_t>(size.y) * static_cast<std::uint64_t>(corner.z));
}

glm::dvec3 place_of(const Organ& organ, const glm::dvec3& index) {
    return glm::dvec3(organ.to_patient() * glm::dvec4(index, 1.0));
}

// The place where the surface crosses an edge of the voxels' boxes.
glm::dvec3 vertex_on(const Organ& organ, const Resection& resection, std::uint64_t edge) {
    const glm::ivec3 size = organ.size() + 1;
    const std::uint64_t number = edge / 4, row = static_cast<std::uint64_t>(size.x);
    const std::uint64_t rows = static_cast<std::uint64_t>(size.y), slice = number / (row * rows);
    const glm::dvec3 from = glm::dvec3(glm::ivec3(number % row, number / row % rows, slice)) - 0.5;
    glm::dvec3 to = from;
    to[static_cast<int>(edge % 4)] += 1.0;
    const glm::dvec3 a = place_of(organ, from), b = place_of(organ, to);
    return glm::mix(a, b, zero_between(resection, a, b, value_at(resection, a), value_at(resection, b)));
}

// The part of a convex polygon that another resection leaves: where its value is above `least`.
std::vector<glm::dvec3> part_left(const std::vector<glm::dvec3>& polygon, const Resection& other, double least) {
    std::vector<double> values;
    for (const glm::dvec3& corner : polygon) values.push_back(value_at(other, corner) - least);
    std::vector<glm::dvec3> part;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
        const std::size_t next = (n + 1) % polygon.size();
        if (values[n] > 0.0) part.push_back(polygon[n]);
        if ((values[n] > 0.0) == (values[next] > 0.0)) continue;
        const double at = zero_between(other, polygon[n], polygon[next], values[n], values[next]);
        part.push_back(glm::mix(polygon[n], polygon[next], at));
    }
    return part;
}

} // namespace

double area_mm2(const ResectionSurface& surface) {
    double area = 0.0;
    for (const glm::uvec3& t : surface.triangles)
        area += 0.5 * glm::length(glm::cross(surface.places[t.y] - surface.places[t.x],
                                             surface.places[t.z] - surface.places[t.x]));
    return area;
}

mesh::TriangleMesh mesh_of(const ResectionSurface& surface) {
    mesh::TriangleMesh mesh;
    for (const glm::dvec3& place : surface.places) mesh.positions.push_back(glm::vec3(place));
    mesh.triangles.assign(surface.triangles.begin(), surface.triangles.end());
    mesh::add_normals(mesh);
    return mesh;
}

unsigned removed_corners(const CornerValues& values) {
    unsigned bits = 0;
    for (unsigned corner = 0; corner < 8; ++corner) bits |= values[corner] > 0.0 ? 0U : 1U << corner;
    return bits;
}

std::vector<std::array<glm::dvec3, 3>> surface_in_box(const Organ& organ, std::span<const Resection> resections,
                                                      std::size_t resection, const glm::dvec3& least, double size) {
    std::array<glm::dvec3, 8> corners{};
    CornerValues values{};
    for (std::size_t c = 0; c < 8; ++c) {
        corners[c] = place_of(organ, least + size * (unit_corner(static_cast<int>(c)) + 0.5));
        values[c] = value_at(resections[resection], corners[c]);
    }
    const volume::CellCase& cell = volume::kCellCases[removed_corners(values)];
    std::array<glm::dvec3, 12> vertices{};
    for (int edge = 0; edge < 12; ++edge) {
        if ((cell.edges >> edge & 1) == 0) continue;
        const volume::CellEdge ends = volume::cell_edge(edge);
        const auto from = static_cast<std::size_t>(ends.from), to = static_cast<std::size_t>(ends.to);
        const double at = zero_between(resections[resection], corners[from], corners[to], values[from], values[to]);
        vertices[static_cast<std::size_t>(edge)] = glm::mix(corners[from], corners[to], at);
    }
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (std::size_t t = 0; t < cell.triangles; ++t) {
        std::vector<glm::dvec3> polygon;
        for (std::size_t n = 0; n < 3; ++n) polygon.push_back(vertices[cell.corners[3 * t + n]]);
        for (std::size_t other = 0; other < resections.size() && !polygon.empty(); ++other) {
            // Where two surfaces coincide, that of the first resection counts.
            constexpr double kSame = 1e-9; // mm
            if (other != resection) polygon = part_left(polygon, resections[other], other > resection ? -kSame : kSame);
        }
        for (std::size_t n = 2; n < polygon.size(); ++n) triangles.push_back({polygon[0], polygon[n - 1], polygon[n]});
    }
    return triangles;
}

void SurfacePieces::add_cell(const Organ& organ, const glm::ivec3& voxel, unsigned removed, std::size_t resection) {
    const volume::CellCase& cell = volume::kCellCases[removed];
    for (std::size_t t = 0; t < cell.triangles; ++t) {
        Cell piece{voxel, static_cast<std::uint8_t>(resection), {}};
        for (std::size_t n = 0; n < 3; ++n) {
            const volume::CellEdge ends = volume::cell_edge(cell.corners[3 * t + n]);
            const glm::ivec3 corner = voxel + glm::ivec3(ends.from & 1, ends.from >> 1 & 1, ends.from >> 2 & 1);
            piece.edges[n] = 4 * corner_number(organ, corner) + static_cast<std::uint64_t>(ends.axis);
        }
        cells_.push_back(piece);
    }
}

void SurfacePieces::add_clipped(const Organ& organ, std::span<const Resection> resections, const glm::ivec3& voxel,
                                std::size_t resection) {
    for (const auto& corners : surface_in_box(organ, resections, resection, glm::dvec3(voxel) - 0.5, 1.0))
        clipped_.push_back({voxel, static_cast<std::uint8_t>(resection), corners});
}

ResectionSurface surface_of(const Organ& organ, std::span<const Resection> resections,
                            std::span<const SurfacePieces> pieces) {
    ResectionSurface surface;
    const bool mirrored = volume::mirrors(organ.to_patient());
    const auto add = [&](glm::uvec3 triangle, const auto& piece) {
        if (mirrored) std::swap(triangle.y, triangle.z);
        surface.triangles.push_back(triangle);
        surface.voxels.push_back(piece.voxel);
        surface.resections.push_back(piece.resection);
    };
    struct Vertex {
        std::uint64_t edge;
        std::size_t resection;
    };
    std::vector<Vertex> vertices;
    std::unordered_map<std::uint64_t, std::uint32_t> known; // by edge and resection
    for (const SurfacePieces& some : pieces)
        for (const SurfacePieces::Cell& cell : some.cells_) {
            glm::uvec3 triangle(0);
            for (int n = 0; n < 3; ++n) {
                const std::uint64_t edge = cell.edges[static_cast<std::size_t>(n)];
                const auto [at, added] = known.try_emplace(kMostResections * edge + cell.resection,
                                                           static_cast<std::uint32_t>(vertices.size()));
                if (added) vertices.push_back({edge, cell.resection});
                triangle[n] = at->second;
            }
            add(triangle, cell);
        }
    surface.places.resize(vertices.size());
    tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t n) {
        surface.places[n] = vertex_on(organ, resections[vertices[n].resection], vertices[n].edge);
    });
    for (const SurfacePieces& some : pieces)
        for (const SurfacePieces::Clipped& loose : some.clipped_) {
            const auto first = static_cast<std::uint32_t>(surface.places.size());
            surface.places.insert(surface.places.end(), loose.corners.begin(), loose.corners.end());
            add({first, first + 1, first + 2}, loose);
        }
    return surface;
}

} // namespace ramus::organ
