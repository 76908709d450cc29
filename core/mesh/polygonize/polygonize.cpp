#include "core/mesh/polygonize/polygonize.h"

#include "core/mesh/polygonize/stream/make_surface_in.h"

namespace ramus::mesh {

namespace {

// The mesh itself.
class MeshStore final : public bricks::SurfaceStore {
public:
    void expect(std::size_t bricks) override {
        // Measured: 12.5 to 15 vertices a brick, and twice as many triangles. Capacity that stays unused takes no
        // memory.
        constexpr std::size_t kVertices = 16;
        mesh_.for_each_array([&](auto& array) { array.reserve(kVertices * bricks); });
        mesh_.triangles.reserve(2 * kVertices * bricks);
    }
    [[nodiscard]] bool resize_vertices(std::size_t count) override {
        mesh_.resize_vertices(count);
        return true;
    }
    void put_vertices(std::size_t at, const bricks::SurfaceVertices& from, std::size_t begin,
                      std::size_t count) override {
        copy_vertices(from, begin, mesh_, at, count);
    }
    [[nodiscard]] VertexSpan vertices() const override { return vertices_of(mesh_); }
    [[nodiscard]] std::span<glm::uvec3> add_triangles(std::size_t count) override {
        const std::size_t first = mesh_.triangles.size();
        mesh_.triangles.resize(first + count);
        return std::span(mesh_.triangles).subspan(first);
    }
    void add_walled(const Bounds<glm::vec3>& box) override { walled_.push_back(box); }
    void release_vertices(std::size_t, std::size_t) override {}
    void end_batch() override {}

    [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }
    [[nodiscard]] std::vector<Bounds<glm::vec3>> take_walled() { return std::move(walled_); }

private:
    TriangleMesh mesh_;
    std::vector<Bounds<glm::vec3>> walled_;
};

} // namespace

Result<TriangleMesh> polygonize(const field::Field& field, const PolygonizeOptions& options, Job& job,
                                PolygonizeStatistics* statistics, std::vector<Bounds<glm::vec3>>* walled) {
    if (field.skeleton().segments().empty())
        return fail("the tree has no segments", {}, "nothing to make a surface of");
    if (field.skeleton().present().empty()) return fail("every branch is hidden", {}, "nothing to make a surface of");
    MeshStore store;
    if (auto made = make_surface_in(store, field, options, PolygonizeMode::kWhole, job, statistics); !made)
        return tl::unexpected(made.error());
    job.report(1.0F);
    if (walled != nullptr) *walled = store.take_walled();
    return store.take();
}

} // namespace ramus::mesh
