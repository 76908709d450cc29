#include "core/mesh/polygonize/join/mesh_slots.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

template <class T> void grow(LargeArray<T>& array, std::uint64_t count, double reserve) {
    if (count > array.capacity())
        array.reserve(count + static_cast<std::uint64_t>(reserve * static_cast<double>(count)));
    if (count > array.size()) array.resize(count);
}

} // namespace

SlotRange MeshSlots::Space::take(std::uint64_t count) {
    const auto found = std::ranges::find_if(free_, [&](const SlotRange& range) { return range.count >= count; });
    if (found != free_.end()) {
        const SlotRange range{found->first, count};
        found->first += count;
        found->count -= count;
        if (found->count == 0) free_.erase(found);
        return range;
    }
    const SlotRange range{end_, count};
    end_ += count;
    return range;
}

void MeshSlots::Space::give_back(SlotRange range) {
    if (range.count == 0) return;
    const auto after = std::ranges::lower_bound(free_, range.first, {}, &SlotRange::first);
    const auto entry = free_.insert(after, range);
    const auto index = static_cast<std::size_t>(entry - free_.begin());
    const auto merge = [&](std::size_t i) { // with the next
        if (i + 1 >= free_.size() || free_[i].first + free_[i].count != free_[i + 1].first) return;
        free_[i].count += free_[i + 1].count;
        free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    };
    merge(index);
    if (index > 0) merge(index - 1);
}

void MeshSlots::grow_vertices(double reserve) {
    mesh_.for_each_array([&](auto& array) { grow(array, vertex_space_.end(), reserve); });
}

void MeshSlots::place_vertices(const Octree& octree, std::span<const std::uint32_t> subtrees, SurfaceCells& surface,
                               double reserve) {
    if (slots_.size() < octree.subtrees.size()) slots_.resize(octree.subtrees.size());
    for (const std::uint32_t subtree : subtrees) {
        slots_[subtree].vertices = vertex_space_.take(surface.subtrees[subtree].vertex_count);
        if (slots_[subtree].vertices.count > 0) edit_.vertices.push_back(slots_[subtree].vertices);
    }
    grow_vertices(reserve);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        SubtreeCells& cells = surface.subtrees[subtrees[t]];
        const std::uint64_t first = slots_[subtrees[t]].vertices.first;
        copy_vertices(*cells.vertices, cells.first_vertex, mesh_, first, cells.vertex_count);
        cells.vertices = nullptr;
        const Subtree& subtree = octree.subtrees[subtrees[t]];
        for (std::uint32_t b = subtree.first_brick; b < subtree.first_brick + subtree.brick_count; ++b)
            if (surface.cells[b].crossed) surface.cells[b].first_vertex += static_cast<std::uint32_t>(first);
    });
    surface.vertices.clear();
}

void MeshSlots::place_triangles(std::span<const std::uint32_t> subtrees, std::vector<JoinedSubtree> joined,
                                double reserve) {
    for (std::size_t t = 0; t < subtrees.size(); ++t) {
        SubtreeSlots& slots = slots_[subtrees[t]];
        slots.triangles = triangle_space_.take(joined[t].triangle_count());
        slots.added = vertex_space_.take(joined[t].added.count);
        if (slots.triangles.count > 0) edit_.triangles.push_back(slots.triangles);
        if (slots.added.count > 0) edit_.vertices.push_back(slots.added);
    }
    grow_vertices(reserve);
    grow(mesh_.triangles, triangle_space_.end(), reserve);
    // All before the first triangle: corners are read with one number of the vertex behind them. They are few.
    for (std::size_t t = 0; t < subtrees.size(); ++t)
        copy_vertices(joined[t].added, 0, mesh_, slots_[subtrees[t]].added.first, joined[t].added.count);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        const SubtreeSlots& slots = slots_[subtrees[t]];
        const auto out = std::span(mesh_.triangles).subspan(slots.triangles.first, slots.triangles.count);
        joined[t].write_triangles(vertices_of(mesh_), slots.added.first, out);
        joined[t] = {};
    });
}

void MeshSlots::remove(std::uint32_t subtree) {
    remove_triangles(subtree);
    vertex_space_.give_back(std::exchange(slots_[subtree].vertices, {}));
}

void MeshSlots::remove_triangles(std::uint32_t subtree) {
    SubtreeSlots& slots = slots_[subtree];
    const auto begin = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(slots.triangles.first);
    std::fill_n(begin, slots.triangles.count, glm::uvec3(0));
    if (slots.triangles.count > 0) edit_.triangles.push_back(slots.triangles);
    triangle_space_.give_back(std::exchange(slots.triangles, {}));
    vertex_space_.give_back(std::exchange(slots.added, {}));
}

SurfaceEdit MeshSlots::take_edit() { return std::exchange(edit_, {}); }

TriangleMesh MeshSlots::compact(std::span<const SubtreeBatch> order) const {
    // The new index of each vertex.
    std::vector<std::uint32_t> index(mesh_.positions.size());
    std::uint32_t vertices = 0;
    std::uint64_t triangles = 0;
    const auto count = [&](const SlotRange& range) {
        for (std::uint64_t n = 0; n < range.count; ++n) index[range.first + n] = vertices++;
    };
    for (const SubtreeBatch& batch : order) {
        for (const std::uint32_t subtree : batch.fill) count(slots_[subtree].vertices);
        for (const std::uint32_t subtree : batch.join)
            count(slots_[subtree].added), triangles += slots_[subtree].triangles.count;
    }
    TriangleMesh mesh;
    mesh.resize_vertices(vertices);
    mesh.triangles.resize(triangles);
    const auto copy = [&](const SlotRange& range) {
        for (std::uint64_t n = range.first; n < range.first + range.count; ++n) {
            mesh.positions[index[n]] = mesh_.positions[n];
            mesh.normals[index[n]] = mesh_.normals[n];
            mesh.radii[index[n]] = mesh_.radii[n];
            mesh.branches[index[n]] = mesh_.branches[n];
            mesh.dominance[index[n]] = mesh_.dominance[n];
        }
    };
    std::uint64_t at = 0;
    for (const SubtreeBatch& batch : order) {
        for (const std::uint32_t subtree : batch.fill) copy(slots_[subtree].vertices);
        for (const std::uint32_t subtree : batch.join) {
            copy(slots_[subtree].added);
            const SlotRange& range = slots_[subtree].triangles;
            for (std::uint64_t n = range.first; n < range.first + range.count; ++n) {
                const glm::uvec3& t = mesh_.triangles[n];
                mesh.triangles[at++] = {index[t.x], index[t.y], index[t.z]};
            }
        }
    }
    return mesh;
}

} // namespace ramus::mesh::bricks
