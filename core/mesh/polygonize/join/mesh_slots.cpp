#include "core/mesh/polygonize/join/mesh_slots.h"

#include "core/mesh/resize_vertices.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

template <class T> void grow(LargeArray<T>& array, std::uint64_t count, double slack) {
    if (count > array.capacity()) array.reserve(count + static_cast<std::uint64_t>(slack * static_cast<double>(count)));
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
    const auto place = free_.insert(after, range);
    const auto index = static_cast<std::size_t>(place - free_.begin());
    const auto merge = [&](std::size_t i) { // with the next
        if (i + 1 >= free_.size() || free_[i].first + free_[i].count != free_[i + 1].first) return;
        free_[i].count += free_[i + 1].count;
        free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    };
    merge(index);
    if (index > 0) merge(index - 1);
}

void MeshSlots::grow_vertices(double slack) {
    const std::uint64_t count = vertex_space_.end();
    grow(mesh_.positions, count, slack);
    grow(mesh_.normals, count, slack);
    grow(mesh_.radii, count, slack);
    grow(mesh_.branches, count, slack);
    grow(mesh_.leads, count, slack);
}

void MeshSlots::place_vertices(const Octree& octree, std::span<const std::uint32_t> tiles, SurfaceCells& surface,
                               double slack) {
    if (slots_.size() < octree.tiles.size()) slots_.resize(octree.tiles.size());
    for (const std::uint32_t tile : tiles) {
        slots_[tile].vertices = vertex_space_.take(surface.tiles[tile].vertex_count);
        if (slots_[tile].vertices.count > 0) edit_.vertices.push_back(slots_[tile].vertices);
    }
    grow_vertices(slack);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
        TileCells& cells = surface.tiles[tiles[t]];
        const std::uint64_t first = slots_[tiles[t]].vertices.first;
        copy_vertices(*cells.vertices, cells.first_vertex, mesh_, first, cells.vertex_count);
        cells.vertices = nullptr;
        const Tile& tile = octree.tiles[tiles[t]];
        for (std::uint32_t b = tile.first_brick; b < tile.first_brick + tile.brick_count; ++b)
            if (surface.cells[b].crossed) surface.cells[b].first_vertex += static_cast<std::uint32_t>(first);
    });
    surface.vertices.clear();
}

void MeshSlots::place_triangles(std::span<const std::uint32_t> tiles, std::vector<JoinedTile> joined, double slack) {
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        TileSlots& slots = slots_[tiles[t]];
        slots.triangles = triangle_space_.take(joined[t].triangle_count());
        slots.added = vertex_space_.take(joined[t].added.count);
        if (slots.triangles.count > 0) edit_.triangles.push_back(slots.triangles);
        if (slots.added.count > 0) edit_.vertices.push_back(slots.added);
    }
    grow_vertices(slack);
    grow(mesh_.triangles, triangle_space_.end(), slack);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
        const TileSlots& slots = slots_[tiles[t]];
        copy_vertices(joined[t].added, 0, mesh_, slots.added.first, joined[t].added.count);
        const auto out = std::span(mesh_.triangles).subspan(slots.triangles.first, slots.triangles.count);
        joined[t].write_triangles(vertices_of(mesh_), slots.added.first, out);
        joined[t] = {};
    });
}

void MeshSlots::remove(std::uint32_t tile) {
    remove_triangles(tile);
    vertex_space_.give_back(std::exchange(slots_[tile].vertices, {}));
}

void MeshSlots::remove_triangles(std::uint32_t tile) {
    TileSlots& slots = slots_[tile];
    const auto begin = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(slots.triangles.first);
    std::fill_n(begin, slots.triangles.count, glm::uvec3(0));
    if (slots.triangles.count > 0) edit_.triangles.push_back(slots.triangles);
    triangle_space_.give_back(std::exchange(slots.triangles, {}));
    vertex_space_.give_back(std::exchange(slots.added, {}));
}

SurfaceEdit MeshSlots::take_edit() { return std::exchange(edit_, {}); }

TriangleMesh MeshSlots::compact(std::span<const TileBatch> order) const {
    // Where each vertex goes.
    std::vector<std::uint32_t> place(mesh_.positions.size());
    std::uint32_t vertices = 0;
    std::uint64_t triangles = 0;
    const auto count = [&](const SlotRange& range) {
        for (std::uint64_t n = 0; n < range.count; ++n) place[range.first + n] = vertices++;
    };
    for (const TileBatch& batch : order) {
        for (const std::uint32_t tile : batch.fill) count(slots_[tile].vertices);
        for (const std::uint32_t tile : batch.join)
            count(slots_[tile].added), triangles += slots_[tile].triangles.count;
    }
    TriangleMesh mesh;
    resize_vertices(mesh, vertices);
    mesh.triangles.resize(triangles);
    const auto copy = [&](const SlotRange& range) {
        for (std::uint64_t n = range.first; n < range.first + range.count; ++n) {
            mesh.positions[place[n]] = mesh_.positions[n];
            mesh.normals[place[n]] = mesh_.normals[n];
            mesh.radii[place[n]] = mesh_.radii[n];
            mesh.branches[place[n]] = mesh_.branches[n];
            mesh.leads[place[n]] = mesh_.leads[n];
        }
    };
    std::uint64_t at = 0;
    for (const TileBatch& batch : order) {
        for (const std::uint32_t tile : batch.fill) copy(slots_[tile].vertices);
        for (const std::uint32_t tile : batch.join) {
            copy(slots_[tile].added);
            const SlotRange& range = slots_[tile].triangles;
            for (std::uint64_t n = range.first; n < range.first + range.count; ++n) {
                const glm::uvec3& t = mesh_.triangles[n];
                mesh.triangles[at++] = {place[t.x], place[t.y], place[t.z]};
            }
        }
    }
    return mesh;
}

} // namespace ramus::mesh::bricks
