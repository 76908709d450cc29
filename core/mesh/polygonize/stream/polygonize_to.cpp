#include "core/base/mapped_pages.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/polygonize/stream/make_surface_in.h"

#include <array>
#include <memory>
#include <oneapi/tbb/task_group.h>

namespace ramus::mesh {

namespace {

// Keeps the vertices that triangles to come may name, and hands what a batch made over while the next one is worked on.
class StreamStore final : public bricks::SurfaceStore {
public:
    explicit StreamStore(SurfaceSink& sink) : sink_(sink) {}
    ~StreamStore() override {
        try {
            handing_over_->wait();
        } catch (...) { // already on the way out
        }
    }

    [[nodiscard]] bool resize_vertices(std::size_t count) override {
        handing_over_->wait(); // vertices may move
        arrays_.positions.resize(count);
        arrays_.normals.resize(count);
        arrays_.radii.resize(count);
        arrays_.branches.resize(count);
        return !full_;
    }
    void put_vertices(std::size_t at, const bricks::SurfaceVertices& from, std::size_t begin,
                      std::size_t count) override {
        copy_vertices(from, begin, arrays_, at, count);
    }
    [[nodiscard]] VertexSpan vertices() const override {
        return {arrays_.positions.values(), arrays_.normals.values(), arrays_.radii.values(),
                arrays_.branches.values()};
    }
    [[nodiscard]] std::span<glm::uvec3> add_triangles(std::size_t count) override {
        triangles_.resize(count);
        return triangles_;
    }
    void release_vertices(std::size_t first, std::size_t end) override { released_.push_back({first, end}); }
    void end_batch() override {
        handing_over_->run([this] { full_ = !hand_over(); });
    }
    [[nodiscard]] bool finish() {
        handing_over_->wait();
        return !full_;
    }

private:
    struct Arrays {
        PagedArray<glm::vec3> positions, normals;
        PagedArray<float> radii;
        PagedArray<std::int32_t> branches;
    };

    bool hand_over() {
        const VertexSpan all = vertices();
        if (!sink_.add_vertices(all.subspan(handed_over_, all.size() - handed_over_))) return false;
        handed_over_ = all.size();
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
    Arrays arrays_;
    LargeArray<glm::uvec3> triangles_; // of one batch
    std::vector<std::array<std::size_t, 2>> released_;
    std::size_t handed_over_ = 0; // vertices
    bool full_ = false;
    std::unique_ptr<tbb::task_group> handing_over_ = std::make_unique<tbb::task_group>();
};

} // namespace

Result<void> polygonize_to(SurfaceSink& sink, const field::Field& field, const PolygonizeOptions& options, Job& job,
                           PolygonizeStatistics* statistics) {
    StreamStore store(sink);
    if (auto made = make_surface_in(store, field, options, PolygonizeMode::kStream, job, statistics); !made)
        return made;
    if (!store.finish()) return fail("the surface cannot be taken further");
    job.report(1.0F);
    return {};
}

} // namespace ramus::mesh
