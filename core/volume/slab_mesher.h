// SlabMesher: builds the marching cubes mesh of a mask in parallel slabs. Slabs have a fixed thickness, and each writes
// its vertices and triangles after those of the previous slabs, so the result does not depend on threads. `Crossing`
// gives the position of vertices: at(axis, voxel) is the fraction, in (0, 1), of the way from `voxel` to the next one
// along `axis`.
//
//     SlabMesher mesher(mask, to_patient, crossing, job);
//     mesher.count();              // then check vertices() and memory
//     auto mesh = mesher.make(memory); // of the mesh
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/volume/cell_table.h"
#include "core/volume/cut_layers.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#include <vector>

namespace ramus::volume {

template <class Crossing> class SlabMesher {
public:
    SlabMesher(const BitMask& mask, const glm::dmat4& to_patient, Crossing crossing, const JobRange& job)
        : rows_(mask), to_patient_(to_patient), crossing_(std::move(crossing)), mirrors_(mirrors(to_patient)),
          job_(job) {
        const int layers = mask.size().z + 1; // the first layer is below the first slice
        slabs_.resize(static_cast<std::size_t>((layers + kLayers - 1) / kLayers));
        filled_.resize(static_cast<std::size_t>(mask.size().z));
        const glm::dmat3 outward = glm::transpose(glm::inverse(glm::dmat3(to_patient)));
        // A tiny part of every normal, which only matters if the triangles around a vertex cancel each other out.
        const double least = 1e-3 * std::pow(voxel_volume_mm3(to_patient), 2.0 / 3.0);
        for (int axis = 0; axis < 3; ++axis)
            outward_[static_cast<std::size_t>(axis)] = glm::vec3(least * glm::normalize(outward[axis]));
    }

    // Computes vertices() and triangles().
    void count() {
        tbb::parallel_for(std::size_t{0}, filled_.size(), [&](std::size_t k) {
            const auto words = rows_.mask().slice(static_cast<int>(k));
            filled_[k] = std::ranges::any_of(words, [](std::uint64_t word) { return word != 0; }) ? 1 : 0;
        });
        for_slabs(0.0F, 0.2F, [&](std::size_t n) { count(n, slabs_[n]); });
        for (std::size_t n = 1; n < slabs_.size(); ++n) {
            slabs_[n].first_vertex = slabs_[n - 1].first_vertex + slabs_[n - 1].vertices;
            slabs_[n].first_triangle = slabs_[n - 1].first_triangle + slabs_[n - 1].triangles;
        }
    }
    [[nodiscard]] std::uint64_t vertices() const { return slabs_.back().first_vertex + slabs_.back().vertices; }
    [[nodiscard]] std::uint64_t triangles() const { return slabs_.back().first_triangle + slabs_.back().triangles; }

    // To be called after count(). vertices() must fit into 32 bits. Fails only when cancelled.
    [[nodiscard]] Result<mesh::TriangleMesh> make(const LargeAllocator<std::byte>& memory) {
        if (job_.cancelled()) return fail("cancelled");
        mesh_ = mesh::TriangleMesh(memory);
        mesh_.positions.resize(vertices());
        mesh_.normals.resize(vertices());
        mesh_.triangles.resize(triangles());
        for_slabs(0.2F, 0.7F, [&](std::size_t n) { emit(n); });
        if (job_.cancelled()) return fail("cancelled");
        for_slabs(0.7F, 0.9F, [&](std::size_t n) { sum_normals(n); });
        for_slabs(0.9F, 1.0F, [&](std::size_t n) { finish_normals(n); });
        if (job_.cancelled()) return fail("cancelled");
        return std::move(mesh_);
    }

private:
    static constexpr int kLayers =
        16; // of a slab; tuned: with fewer, more slices are scanned twice; with more, fewer threads are busy

    struct Slab {
        std::uint64_t vertices = 0, triangles = 0, first_vertex = 0, first_triangle = 0;
        std::vector<glm::vec3> beyond; // contributions to the normals of the next slab's first vertices
    };

    template <class Work> void for_slabs(float begin, float end, const Work& work) {
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, slabs_.size(), [&](std::size_t n) {
            if (job_.cancelled()) return;
            work(n);
            job_.report(begin + (end - begin) * static_cast<float>(++done) / static_cast<float>(slabs_.size()));
        });
    }
    [[nodiscard]] bool filled(int k) const {
        return k >= 0 && k < rows_.mask().size().z && filled_[static_cast<std::size_t>(k)] != 0;
    }
    template <class Visit> void for_layers(std::size_t slab, const Visit& visit) const {
        const int begin = -1 + static_cast<int>(slab) * kLayers;
        const int end = std::min(begin + kLayers, rows_.mask().size().z);
        for (int k = begin; k < end; ++k)
            if (filled(k) || filled(k + 1)) visit(k);
    }

    void count(std::size_t n, Slab& slab) {
        SliceCuts slice;
        LayerCuts layer;
        for_layers(n, [&](int k) {
            if (filled(k)) {
                slice.find(rows_, k);
                slab.vertices += slice.count;
            }
            layer.find(rows_, k);
            slab.vertices += layer.count;
            for_cut_cells(rows_, k, [&](std::size_t, std::size_t, std::size_t, unsigned inside) {
                slab.triangles += kCellCases[inside].triangles;
            });
        });
    }

    void emit(std::size_t n) {
        SliceCuts lower;
        SliceCuts upper;
        LayerCuts layer;
        int lower_is = -2; // the slice of `lower`
        auto vertex = static_cast<std::uint32_t>(slabs_[n].first_vertex);
        auto* triangle = mesh_.triangles.data() + slabs_[n].first_triangle;
        for_layers(n, [&](int k) {
            // A slice that is completely outside has no cut edges, and they are not looked up.
            if (lower_is != k) {
                lower.count = 0;
                if (filled(k)) lower.find(rows_, k);
            }
            upper.count = 0;
            if (filled(k + 1)) upper.find(rows_, k + 1);
            layer.find(rows_, k);
            const std::uint32_t first_lower = vertex;
            if (lower.count > 0) put_vertices(lower.x, lower.y, k, vertex);
            const std::uint32_t first_between = vertex;
            put_vertices(layer.z, k, vertex);
            const std::uint32_t first_upper = vertex;
            const std::size_t words = rows_.mask().row_words();
            for_cut_cells(rows_, k, [&](std::size_t row, std::size_t word, std::size_t bit, unsigned inside) {
                const CellCase& cell = kCellCases[inside];
                std::array<std::uint32_t, 12> at;
                for (unsigned left = cell.edges; left != 0; left &= left - 1) {
                    const int edge = std::countr_zero(left);
                    const CellEdge ends = cell_edge(edge);
                    const std::size_t column = bit + (ends.from & 1U);
                    const std::size_t w = (row + (ends.from >> 1 & 1U)) * words + word + column / 64;
                    const SliceCuts& slice = (ends.from & 4) != 0 ? upper : lower;
                    const Cuts& cuts = ends.axis == 0 ? slice.x : ends.axis == 1 ? slice.y : layer.z;
                    const std::uint32_t first = ends.axis == 2         ? first_between
                                                : (ends.from & 4) != 0 ? first_upper
                                                                       : first_lower;
                    at[static_cast<std::size_t>(edge)] = first + cuts.number_of(w, column % 64);
                }
                for (std::size_t c = 0; c < 3 * std::size_t{cell.triangles}; c += 3) {
                    *triangle = {at[cell.corners[c]], at[cell.corners[c + 1]], at[cell.corners[c + 2]]};
                    if (mirrors_) std::swap(triangle->y, triangle->z);
                    ++triangle;
                }
            });
            std::swap(lower, upper);
            lower_is = k + 1;
        });
    }

    void put_row(const Cuts& cuts, int axis, int j, int k, std::uint32_t& vertex) {
        const std::size_t words = rows_.mask().row_words();
        const std::uint64_t* const first = cuts.words.data() + static_cast<std::size_t>(j + 1) * words;
        const std::uint64_t* const inside = rows_.row(j, k);
        for (std::size_t word = 0; word < words; ++word) {
            for (std::uint64_t left = first[word]; left != 0; left &= left - 1) {
                const int bit = std::countr_zero(left);
                const glm::ivec3 voxel(static_cast<int>(64 * word) + bit - 1, j, k);
                glm::dvec4 place(voxel, 1.0);
                place[axis] += crossing_.at(axis, voxel);
                mesh_.positions[vertex] = glm::vec3(to_patient_ * place);
                const glm::vec3& outward = outward_[static_cast<std::size_t>(axis)];
                mesh_.normals[vertex] = (inside[word] >> bit & 1) != 0 ? outward : -outward;
                ++vertex;
            }
        }
    }
    void put_vertices(const Cuts& x, const Cuts& y, int k, std::uint32_t& vertex) {
        for (int j = -1; j < rows_.mask().size().y; ++j) {
            put_row(x, 0, j, k, vertex);
            put_row(y, 1, j, k, vertex);
        }
    }
    void put_vertices(const Cuts& z, int k, std::uint32_t& vertex) {
        for (int j = 0; j < rows_.mask().size().y; ++j) put_row(z, 2, j, k, vertex);
    }

    void sum_normals(std::size_t n) {
        Slab& slab = slabs_[n];
        const std::uint64_t end = slab.first_vertex + slab.vertices;
        for (std::uint64_t t = 0; t < slab.triangles; ++t) {
            const glm::uvec3& triangle = mesh_.triangles[slab.first_triangle + t];
            const glm::vec3& a = mesh_.positions[triangle.x];
            const glm::vec3 twice = glm::cross(mesh_.positions[triangle.y] - a, mesh_.positions[triangle.z] - a);
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = triangle[corner];
                if (vertex < end) {
                    mesh_.normals[vertex] += twice;
                    continue;
                }
                if (slab.beyond.size() <= vertex - end) slab.beyond.resize(vertex - end + 1, glm::vec3(0.0F));
                slab.beyond[vertex - end] += twice;
            }
        }
    }

    void finish_normals(std::size_t n) {
        const Slab& slab = slabs_[n];
        if (n > 0)
            for (std::size_t v = 0; v < slabs_[n - 1].beyond.size(); ++v)
                mesh_.normals[slab.first_vertex + v] += slabs_[n - 1].beyond[v];
        for (std::uint64_t v = slab.first_vertex; v < slab.first_vertex + slab.vertices; ++v)
            mesh_.normals[v] = glm::vec3(glm::normalize(glm::dvec3(mesh_.normals[v])));
    }

    PaddedRows rows_;
    glm::dmat4 to_patient_;
    Crossing crossing_;
    bool mirrors_;
    const JobRange& job_;
    std::array<glm::vec3, 3> outward_{}; // normal of each axis in the patient's space
    std::vector<std::uint8_t> filled_;   // by slice: 1 if a voxel is inside
    std::vector<Slab> slabs_;
    mesh::TriangleMesh mesh_;
};

} // namespace ramus::volume
