#include "core/base/mapped_pages.h"
#include "core/mesh/edge_balance.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/polygonize/stream/make_surface_in.h"

#include <array>
#include <memory>
#include <oneapi/tbb/task_group.h>

namespace ramus::mesh {

namespace {

// Keeps the vertices that triangles to come may name, and hands what a batch made over while the next one is worked on.
// Vertices of surfaces before this one have places in the arrays, so that triangles name all by one count; the pages of
// those places are never touched.
class StreamStore final : public bricks::SurfaceStore {
public:
    StreamStore(SurfaceSink& sink, std::size_t first_vertex)
        : sink_(sink), first_vertex_(first_vertex), handed_over_(first_vertex) {}
    ~StreamStore() override {
        try {
            handing_over_->wait();
        } catch (...) { // already on the way out
        }
    }

    [[nodiscard]] bool resize_vertices(std::size_t count) override {
        handing_over_->wait(); // vertices may move
        const std::size_t all = first_vertex_ + count;
        arrays_.positions.resize(all);
        arrays_.normals.resize(all);
        arrays_.radii.resize(all);
        arrays_.branches.resize(all);
        return !full_;
    }
    void put_vertices(std::size_t at, const bricks::SurfaceVertices& from, std::size_t begin,
                      std::size_t count) override {
        copy_vertices(from, begin, arrays_, first_vertex_ + at, count);
    }
    [[nodiscard]] VertexSpan vertices() const override {
        const VertexSpan all = every_vertex();
        return all.subspan(first_vertex_, all.size() - first_vertex_);
    }
    [[nodiscard]] std::span<glm::uvec3> add_triangles(std::size_t count) override {
        triangles_.resize(count);
        return triangles_;
    }
    void release_vertices(std::size_t first, std::size_t end) override {
        released_.push_back({first_vertex_ + first, first_vertex_ + end});
    }
    void end_batch() override {
        handing_over_->run([this] { full_ = !hand_over(); });
    }
    [[nodiscard]] bool finish() {
        handing_over_->wait();
        return !full_;
    }
    [[nodiscard]] Result<void> check_closed() const { return balance_.check(); } // after finish()

private:
    struct Arrays {
        PagedArray<glm::vec3> positions, normals;
        PagedArray<float> radii;
        PagedArray<std::int32_t> branches;
    };

    [[nodiscard]] VertexSpan every_vertex() const {
        return {arrays_.positions.values(), arrays_.normals.values(), arrays_.radii.values(),
                arrays_.branches.values()};
    }
    bool hand_over() {
        const VertexSpan all = every_vertex();
        const VertexSpan more = all.subspan(handed_over_, all.size() - handed_over_);
        balance_.add_vertices(more.positions);
        balance_.add_triangles(triangles_); // named by their places in this surface
        if (!sink_.add_vertices(more)) return false;
        handed_over_ = all.size();
        if (first_vertex_ > 0)
            for (glm::uvec3& triangle : triangles_) triangle += static_cast<std::uint32_t>(first_vertex_);
        if (!sink_.add_triangles(triangles_, all)) return false;
        for (const auto& [first, end] : released_) {
            empty(arrays_.positions, first, end), empty(arrays_.normals, first, end);
            empty(arrays_.radii, first, end), empty(arrays_.branches, first, end);
        }
        released_.clear();
        return true;
    }
    template <class T> static void empty(PagedArray<T>& array, std::size_t first, std::size_t end) {
        empty_pages(array.data() + first, (end - first) * sizeof(T));
    }

    SurfaceSink& sink_;
    std::size_t first_vertex_;
    Arrays arrays_;
    LargeArray<glm::uvec3> triangles_; // of one batch
    std::vector<std::array<std::size_t, 2>> released_;
    std::size_t handed_over_; // vertices
    EdgeBalance balance_;
    bool full_ = false;
    std::unique_ptr<tbb::task_group> handing_over_ = std::make_unique<tbb::task_group>();
};

} // namespace

Result<void> polygonize_to(SurfaceSink& sink, const field::Field& field, const PolygonizeOptions& options, Job& job,
                           PolygonizeStatistics* statistics, std::size_t first_vertex) {
    StreamStore store(sink, first_vertex);
    if (auto made = make_surface_in(store, field, options, PolygonizeMode::kStream, job, statistics); !made)
        return made;
    if (!store.finish()) return fail("the surface cannot be taken further");
    job.report(1.0F);
    return store.check_closed();
}

} // namespace ramus::mesh
