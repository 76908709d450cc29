// SurfaceBatches: the surface of an octree, computed in batches (octree/subtree_schedule.h), so that the working set
// fits into the caches, and finished parts can be freed. Of an octree of which only some subtrees are built
// (octree/partial_octree.h), the part of the surface that these have.
#pragma once

#include "core/base/bounds.h"
#include "core/base/job.h"
#include "core/field/field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/octree/octree.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// What a subtree adds to the mesh: vertices of its cells, vertices that joining it adds, triangles.
struct SubtreeCounts {
    std::uint32_t vertices = 0, added = 0, triangles = 0;
};
// Where it adds them.
struct SubtreePlaces {
    std::uint64_t vertices = 0, added = 0, triangles = 0;
};

// Consecutive subtrees in the octree's order.
struct SubtreeRange {
    std::uint32_t first = 0, end = 0xFFFFFFFFU;
    [[nodiscard]] bool holds(std::uint32_t subtree) const { return subtree >= first && subtree < end; }
};

class SurfaceBatches {
public:
    // `octree`: freshly built. Its lists are freed during the work. `own`: the subtrees that are joined; others are
    // filled because these touch them.
    SurfaceBatches(const field::Field& field, Octree& octree, const LargeAllocator<std::byte>& memory,
                   SubtreeRange own = {});

    enum class End { kDone, kCancelled, kTooManyVertices };
    // Fills and joins the subtrees of these batches.
    [[nodiscard]] End work(std::span<const SubtreeBatch> batches, Job& job);

    // Of the own subtrees.
    [[nodiscard]] const PolygonizeStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::uint64_t border_evaluations() const { return border_evaluations_; } // of the others
    // By subtree; valid for those that were joined, `vertices` also for those that were filled.
    [[nodiscard]] std::span<const SubtreeCounts> counts() const { return counts_; }
    [[nodiscard]] std::span<const SubtreePlaces> places() const { return places_; }
    [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }
    // Boxes around the own bricks that have cells with walls between vessels, mm.
    [[nodiscard]] std::vector<Bounds<glm::vec3>> take_walled() { return std::move(walled_); }

private:
    [[nodiscard]] End work(const SubtreeBatch& batch, const JobRange& job);
    [[nodiscard]] End place_vertices(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End place_triangles(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End grow_vertices(std::size_t count);
    void tell_walls(std::span<const std::uint32_t> subtrees);
    void drop(std::span<const std::uint32_t> subtrees);
    void empty(std::uint32_t first_subtree, std::uint32_t end_subtree);
    [[nodiscard]] std::uint32_t brick_end(std::uint32_t subtree) const {
        return octree_.subtrees[subtree].first_brick + octree_.subtrees[subtree].brick_count;
    }

    field::Field field_;
    Octree& octree_;
    SubtreeRange own_;
    TriangleMesh mesh_;
    std::vector<Bounds<glm::vec3>> walled_;
    SurfaceCells cells_;
    std::vector<bool> dropped_;         // by subtree
    std::vector<JoinedSubtree> joined_; // of one batch
    std::vector<SubtreeCounts> counts_; // by subtree
    std::vector<SubtreePlaces> places_;
    PolygonizeStatistics statistics_;
    std::uint64_t border_evaluations_ = 0;
};

// The error of work that did not end well.
[[nodiscard]] Result<void> result_of(SurfaceBatches::End end, const PolygonizeOptions& options);

} // namespace ramus::mesh::bricks
