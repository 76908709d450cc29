// The steps of polygonizing, into whatever store.
#pragma once

#include "core/base/bounds.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/polygonize.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace ramus::mesh {

namespace bricks {

// Where a surface is put while it is made, batch after batch.
class SurfaceStore {
public:
    SurfaceStore() = default;
    SurfaceStore(const SurfaceStore&) = delete;
    SurfaceStore& operator=(const SurfaceStore&) = delete;
    virtual ~SurfaceStore() = default;

    // Told before all else.
    virtual void expect([[maybe_unused]] std::size_t bricks) {}
    // Provides for so many vertices in all. False: it cannot take them.
    [[nodiscard]] virtual bool resize_vertices(std::size_t count) = 0;
    // Copies `count` vertices of `from`, those from `begin` on, to the vertices from `at` on.
    virtual void put_vertices(std::size_t at, const SurfaceVertices& from, std::size_t begin, std::size_t count) = 0;
    [[nodiscard]] virtual VertexSpan vertices() const = 0;
    // Provides for so many more triangles, all of which will be written.
    [[nodiscard]] virtual std::span<glm::uvec3> add_triangles(std::size_t count) = 0;
    // Vertices that no triangle to come will name.
    virtual void release_vertices(std::size_t first, std::size_t end) = 0;
    // Around a brick that has cells with walls between vessels, mm.
    virtual void add_walled([[maybe_unused]] const Bounds<glm::vec3>& box) {}
    // All that was added is there.
    virtual void end_batch() = 0;
};

} // namespace bricks

// Fails when the surface is not feasible in that mode, when the store is full, or when cancelled.
[[nodiscard]] Result<void> make_surface_in(bricks::SurfaceStore& store, const field::Field& field,
                                           const PolygonizeOptions& options, PolygonizeMode mode, Job& job,
                                           PolygonizeStatistics* statistics);

} // namespace ramus::mesh
