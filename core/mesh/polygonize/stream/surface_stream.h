// SurfaceStream: makes the surface of an octree's bricks in batches (octree/subtree_schedule.h), so that what is worked
// on is small enough for the caches, and what is done with can go.
#pragma once

#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"
#include "core/mesh/polygonize/stream/surface_store.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

class SurfaceStream {
public:
    // The octree freshly built. Its lists are emptied on the way.
    SurfaceStream(const field::Field& field, Octree& octree, SurfaceStore& store);

    enum class End { kDone, kCancelled, kTooManyVertices, kStoreIsFull };
    [[nodiscard]] End work(Job& job);

    [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
    [[nodiscard]] std::uint64_t samples() const { return samples_; }
    [[nodiscard]] double fill_s() const { return fill_s_; }
    [[nodiscard]] double join_s() const { return join_s_; }

private:
    [[nodiscard]] End work(const SubtreeBatch& batch, const JobRange& job);
    [[nodiscard]] End place_vertices(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End place_triangles(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End grow_vertices(std::size_t count);
    void drop(std::span<const std::uint32_t> subtrees);
    void empty(std::uint32_t first_subtree, std::uint32_t end_subtree);
    [[nodiscard]] std::uint32_t brick_end(std::uint32_t subtree) const {
        return octree_.subtrees[subtree].first_brick + octree_.subtrees[subtree].brick_count;
    }

    field::Field field_;
    Octree& octree_;
    SurfaceStore& store_;
    SurfaceCells cells_;
    struct SubtreeVertices {
        std::size_t first = 0, end = 0;
    };
    std::vector<SubtreeVertices> placed_; // by subtree
    std::vector<bool> dropped_;           // by subtree
    std::vector<JoinedSubtree> joined_;   // of one batch
    std::size_t vertex_count_ = 0;
    std::uint64_t evaluations_ = 0, samples_ = 0;
    double fill_s_ = 0.0, join_s_ = 0.0;
};

} // namespace ramus::mesh::bricks
