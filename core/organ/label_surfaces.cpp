#include "core/organ/label_surfaces.h"

#include "core/base/disjoint_sets.h"
#include "core/mesh/vertex_normals.h"
#include "core/organ/surfaces/fit_volumes.h"
#include "core/organ/surfaces/label_net.h"
#include "core/organ/surfaces/relax_net.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace ramus::organ {

namespace {

using surfaces::LabelNet;

// The number of a label, from 0 for the outside of the organ.
std::size_t number_of(int label) { return static_cast<std::size_t>(label - kOutside); }

// By number of a label: its voxels.
std::vector<double> voxels_of(std::span<const int> labels) {
    std::vector<double> voxels(1, 0.0);
    for (const int label : labels) {
        if (number_of(label) >= voxels.size()) voxels.resize(number_of(label) + 1, 0.0);
        ++voxels[number_of(label)];
    }
    return voxels;
}

std::vector<std::uint32_t> least_voxels(const LabelNet& net, const std::vector<double>& voxels) {
    std::vector<std::uint32_t> least(net.corners.size(), std::numeric_limits<std::uint32_t>::max());
    const auto touch = [&](std::uint32_t vertex, const Sides& sides) {
        for (const int label : {sides.inside, sides.outside})
            if (label != kOutside)
                least[vertex] = std::min(least[vertex], static_cast<std::uint32_t>(voxels[number_of(label)]));
    };
    for (std::size_t n = 0; n < net.quads.size(); ++n)
        for (const std::uint32_t vertex : net.quads[n]) touch(vertex, net.quad_sides[n]);
    for (std::size_t n = 0; n < net.triangles.size(); ++n)
        for (int corner = 0; corner < 3; ++corner) touch(net.triangles[n][corner], net.triangle_sides[n]);
    return least;
}

// Divides all quads along the diagonal that is shorter in mm.
void add_triangles(const LabelNet& net, const LargeArray<glm::vec3>& places, const glm::dmat3& to_mm,
                   LabelSurfaces& surfaces) {
    const glm::mat3 axes(to_mm);
    auto& triangles = surfaces.mesh.triangles;
    triangles.reserve(2 * net.quads.size() + net.triangles.size());
    surfaces.sides.reserve(triangles.capacity());
    const auto length = [&](std::uint32_t a, std::uint32_t b) { return glm::length(axes * (places[a] - places[b])); };
    for (std::size_t n = 0; n < net.quads.size(); ++n) {
        const auto& [a, b, c, d] = net.quads[n];
        if (length(a, c) <= length(b, d)) {
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        } else {
            triangles.push_back({a, b, d});
            triangles.push_back({b, c, d});
        }
        surfaces.sides.insert(surfaces.sides.end(), 2, net.quad_sides[n]);
    }
    triangles.insert(triangles.end(), net.triangles.begin(), net.triangles.end());
    surfaces.sides.insert(surfaces.sides.end(), net.triangle_sides.begin(), net.triangle_sides.end());
}

void fit(LabelSurfaces& result, const std::vector<double>& voxels, const LabelNet& net, bool mirrored,
         LargeArray<glm::vec3>& places, const JobRange& job) {
    std::vector<std::array<std::uint32_t, 2>> numbers;
    numbers.reserve(result.sides.size());
    for (const Sides& sides : result.sides)
        numbers.push_back({static_cast<std::uint32_t>(number_of(sides.inside)),
                           static_cast<std::uint32_t>(number_of(sides.outside))});
    surfaces::fit_volumes({result.mesh.triangles, numbers, voxels, mirrored ? -1.0 : 1.0}, net.corners, places, job);
}

} // namespace

Result<LabelSurfaces> label_surfaces(const Organ& organ, std::span<const int> labels, const JobRange& job) {
    LabelSurfaces result;
    if (organ.count() == 0) return result;
    const auto net = surfaces::label_net(organ, labels, job.part(0.0F, 0.3F));
    if (job.cancelled()) return fail("cancelled");
    if (!net)
        return fail("the borders of the territories have too many vertices for a mesh", {},
                    "crop the organ, or divide it less");
    const std::vector<double> voxels = voxels_of(labels);
    auto places = surfaces::relaxed(*net, least_voxels(*net, voxels), job.part(0.3F, 0.7F));
    const glm::dmat3 axes(organ.to_patient());
    add_triangles(*net, places, axes, result);
    fit(result, voxels, *net, glm::determinant(axes) < 0.0, places, job.part(0.7F, 1.0F));
    if (job.cancelled()) return fail("cancelled");
    for (glm::vec3& place : places)
        place = glm::vec3(glm::dvec3(organ.to_patient() * glm::dvec4(glm::dvec3(place), 1.0)));
    result.mesh.positions = std::move(places);
    return result;
}

namespace {

// The edges of triangles: equal ones follow each other.
struct Edge {
    std::uint32_t low, high;       // vertices
    std::uint32_t at_low, at_high; // corners of the triangle, numbered through
};

// Joins the corners of triangles that have an edge in common, so that each ring around a vertex is a set.
DisjointSets rings_of(const std::vector<glm::uvec3>& triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t next = (corner + 1) % 3;
            const std::uint32_t a = triangles[t][static_cast<int>(corner)], b = triangles[t][static_cast<int>(next)];
            if (a < b)
                edges.push_back({a, b, 3 * t + corner, 3 * t + next});
            else
                edges.push_back({b, a, 3 * t + next, 3 * t + corner});
        }
    std::ranges::sort(edges, {}, [](const Edge& edge) { return std::tuple(edge.low, edge.high, edge.at_low); });
    DisjointSets rings(3 * triangles.size());
    for (std::size_t n = 1; n < edges.size(); ++n) {
        const Edge &one = edges[n - 1], &other = edges[n];
        if (one.low != other.low || one.high != other.high) continue;
        (void)rings.join(one.at_low, other.at_low);
        (void)rings.join(one.at_high, other.at_high);
    }
    return rings;
}

} // namespace

mesh::TriangleMesh surface_of(const LabelSurfaces& surfaces, int label) {
    std::vector<glm::uvec3> triangles;
    for (std::size_t n = 0; n < surfaces.sides.size(); ++n) {
        const glm::uvec3& t = surfaces.mesh.triangles[n];
        if (surfaces.sides[n].inside == label) triangles.push_back(t);
        if (surfaces.sides[n].outside == label) triangles.push_back({t.z, t.y, t.x});
    }
    DisjointSets rings = rings_of(triangles);
    mesh::TriangleMesh mesh;
    std::vector<std::uint32_t> vertices(3 * triangles.size()); // by corner
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        glm::uvec3 triangle(0);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t at = 3 * t + static_cast<std::uint32_t>(corner), first = rings.find(at);
            if (first == at) {
                vertices[at] = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(surfaces.mesh.positions[triangles[t][corner]]);
            }
            triangle[corner] = vertices[first]; // the lowest corner of the ring came before
        }
        mesh.triangles.push_back(triangle);
    }
    mesh::add_normals(mesh);
    return mesh;
}

} // namespace ramus::organ
