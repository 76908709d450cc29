// PartMaking: makes one part of a surface, by itself or as a process of a team.
#pragma once

#include "core/base/team.h"
#include "core/mesh/polygonize/octree/partial_octree.h"
#include "core/mesh/polygonize/octree/sizing.h"
#include "core/mesh/polygonize/part.h"
#include "core/mesh/polygonize/surface_batches.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// Call plan(), then work().
class PartMaking {
public:
    // `team`: of which each process makes a part; null: this process counts the work of all parts itself. Keeps
    // references to the field and the options.
    PartMaking(const field::Field& field, const PolygonizeOptions& options, const PartOf& part, Team* team);

    // Divides the octree, and checks that the own part fits into memory.
    Result<void> plan(Job& job);
    Result<void> work(Job& job);

    [[nodiscard]] SubtreeRange range() const { return ranges_[part_.index]; }
    [[nodiscard]] std::span<const SubtreeRange> ranges() const { return ranges_; }
    [[nodiscard]] std::span<const SubtreeBatch> schedule() const { return schedule_; }
    [[nodiscard]] std::span<const std::uint8_t> filled() const { return fill_; }
    // With the vertices of all subtrees that were filled, and the triangles of the own ones.
    [[nodiscard]] TriangleMesh& mesh() { return mesh_; }
    [[nodiscard]] SurfaceBatches& batches() { return *batches_; }
    [[nodiscard]] PartStatistics& statistics() { return statistics_; }

private:
    [[nodiscard]] std::vector<FoundSubtrees> found_by_all(const Job& job) const; // by process

    const field::Field& field_;
    const PolygonizeOptions& options_;
    PartOf part_;
    Team* team_;
    LargeAllocator<std::byte> memory_;
    Sizing sizing_;
    std::unique_ptr<PartialOctree> octree_;
    std::vector<SubtreeRange> ranges_; // by part
    std::vector<std::uint8_t> fill_;   // by subtree
    std::vector<SubtreeBatch> schedule_;
    std::unique_ptr<SurfaceBatches> batches_;
    TriangleMesh mesh_;
    PartStatistics statistics_;
};

} // namespace ramus::mesh::bricks
