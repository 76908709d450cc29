#include "app/workspace/tree_loader.h"

#include <memory>
#include <oneapi/tbb/task_arena.h>

namespace ramus::app {

namespace {

// While the window comes up, and draws the cones, one core is free.
Result<ReadySurface> first_surface(SurfaceMaker& maker, const SurfaceRequest& request, std::size_t segments, Job& job) {
    constexpr std::size_t kMany = 100'000; // there the surface is what takes time, and wants all cores
    if (segments > kMany) return maker.next(request, job);
    tbb::task_arena one(1);
    return one.execute([&] { return maker.next(request, job); });
}

} // namespace

void TreeLoader::start(const std::filesystem::path& path, Read read) {
    arrival_.reset();
    first_.reset();
    worker_.start(
        "Reading " + path.filename().string(),
        [this, path, read = std::move(read)](Job& job, const Worker::Post& post) { work(path, read, job, post); });
}

void TreeLoader::work(const std::filesystem::path& path, const Read& read, Job& job, const Worker::Post& post) {
    auto loaded = read(job);
    if (job.cancelled()) return;
    if (!loaded) {
        post([this, error = loaded.error()] { error_ = error; });
        return;
    }
    const SurfaceRequest request = surface_request(loaded->session.marks);
    const auto maker = loaded->maker;
    const std::size_t segments = loaded->assets.tree->segment_count();
    // std::function wants something to copy.
    const auto shared = std::make_shared<LoadedTree>(std::move(*loaded));
    post([this, path, shared] { arrival_ = Arrival{path, std::move(*shared)}; });
    auto first = first_surface(*maker, request, segments, job);
    if (first && !job.cancelled()) post([this, first] { first_ = *first; });
}

void TreeLoader::cancel() { worker_.cancel(); }

void TreeLoader::update() { worker_.drain(); }

} // namespace ramus::app
