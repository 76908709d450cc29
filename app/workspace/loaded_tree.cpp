#include "app/workspace/loaded_tree.h"

#include "app/session/carry_over.h"
#include "app/session/reading_options.h"
#include "app/session/session_file.h"
#include "app/session/systems.h"
#include "app/session/tree_edits.h"
#include "app/session/usual_sizes.h"
#include "app/storage/opening_files.h"
#include "core/base/stopwatch.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <memory>
#include <oneapi/tbb/task_arena.h>
#include <utility>

namespace ramus::app {

namespace {

// A session's tree, and its cones. `where` names the session in messages; empty: it is a fresh one.
Result<LoadedTree> load_tree_of(Session opened, const std::string& where, const io::ReadOptions& said, Job& job) {
    const Stopwatch watch;
    LoadedTree loaded;
    loaded.session = std::move(opened);
    Session& session = loaded.session;
    if (session.tree.path.empty()) { // what is shown without a tree is read as all context is
        if (auto fits = check_against(session, {}, {}, where); !fits) return tl::unexpected(fits.error());
        return loaded;
    }
    session.marks.reading = over(said, session.marks.reading);
    auto tree = read_tree_or_mask(session.tree.path, session.marks.reading,
                                  static_cast<double>(session.marks.options.memory_bytes), job);
    if (!tree) return tl::unexpected(tree.error());
    RAMUS_TRY(checksum, checksum_of(session.tree.path));
    const auto base = std::make_shared<const tree::VesselTree>(std::move(*tree));
    RAMUS_TRY(edited, with_edits(base, session, checksum, where));
    if (!where.empty())
        if (auto fits = check_against(session, *edited, checksum, where); !fits) return tl::unexpected(fits.error());
    session.tree.checksum = checksum;
    if (where.empty()) {
        follow_unit(session.marks, session.tree);
        session.marks.planning = usual_sizes(*edited).planning;
        session.marks.colour_by = first_colouring(session.marks.colour_by, *edited);
    }
    Assets& assets = loaded.assets;
    assets.tree = edited;
    assets.facts = std::make_shared<const TreeFacts>(facts_of(*edited));
    loaded.base = base;
    loaded.maker = std::make_shared<SurfaceMaker>(assets.tree);
    loaded.seconds = watch.seconds();

    RAMUS_TRY(cones, first_cones(*assets.tree, surface_request(session.marks), job));
    loaded.cones = std::move(cones);
    const mesh::SurfaceOptions& options = session.marks.options;
    assets.centerlines = centerlines_of(*assets.tree, options);
    const auto& lines = assets.centerlines.lines;
    const DrawnWidth width = drawn_width(options, options.method);
    if (drawn_along_lines(options, options.method) && lines->points.size() <= render::caster::kMostCastPoints)
        assets.centerlines.cones = render::caster::fitted_cones(lines, width.width, width.beyond_ends);
    return loaded;
}

// While the window comes up, and draws the cones, one core is free.
Result<ReadySurface> first_surface(SurfaceMaker& maker, const SurfaceRequest& request, std::size_t segments, Job& job) {
    constexpr std::size_t kMany = 100'000; // there the surface is what takes time, and wants all cores
    if (segments > kMany) return maker.next(request, job);
    tbb::task_arena one(1);
    return one.execute([&] { return maker.next(request, job); });
}

} // namespace

Result<LoadedTree> load(const std::filesystem::path& path, const Marks& like, const io::ReadOptions& reading,
                        Job& job) {
    if (is_session_file(path)) {
        RAMUS_TRY(saved, read_session(path));
        auto loaded = load_tree_of(std::move(saved.session), path.string(), reading, job);
        if (!loaded) return loaded;
        loaded->has_camera = saved.has_camera;
        loaded->session.marks.options.threads = like.options.threads; // the machine's business, not the session's
        loaded->session.marks.options.memory_bytes = like.options.memory_bytes;
        loaded->file = std::filesystem::absolute(path).lexically_normal();
        return loaded;
    }
    Session fresh;
    fresh.tree.path = std::filesystem::absolute(path).lexically_normal();
    fresh.marks.options = like.options;
    fresh.marks.colour_map = like.colour_map;
    fresh.marks.context = like.context;
    fresh.marks.scans = like.scans;
    std::erase_if(fresh.marks.context, [&](const ContextItem& item) { return item.file == fresh.tree.path; });
    // The mask's own surface beside that of the tree made of it. A scan is no mask to compare with, nor is
    // one of several channels, which the comparison cannot choose.
    if (io::is_volume(path) && !reading.mask.isovalue && reading.part == io::VolumePart{}) {
        fresh.marks.comparison.mode = Comparison::Mode::kSideBySide;
        fresh.marks.comparison.surfaces = {Compared::kConvolutionSurface, Compared::kIsosurface};
        fresh.marks.comparison.mask = fresh.tree.path.string();
    }
    return load_tree_of(std::move(fresh), {}, reading, job);
}

Result<LoadedTree> load(const autosave::Snapshot& snapshot, Job& job) {
    auto loaded = load_tree_of(snapshot.session, snapshot.session.tree.path.string(), {}, job);
    if (!loaded) {
        loaded.error().hint = "its recovery file is kept until you discard it";
        return loaded;
    }
    loaded->has_camera = true;
    loaded->file = snapshot.file;
    loaded->unsaved_changes = snapshot.changes;
    return loaded;
}

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
    const std::size_t segments = maker ? loaded->assets.tree->segment_count() : 0;
    // std::function wants something to copy.
    const auto shared = std::make_shared<LoadedTree>(std::move(*loaded));
    post([this, path, shared] { arrival_ = Arrival{path, std::move(*shared)}; });
    if (!maker) return;
    auto first = first_surface(*maker, request, segments, job);
    if (first && !job.cancelled()) post([this, first] { first_ = *first; });
}

void TreeLoader::cancel() { worker_.cancel(); }

void TreeLoader::update() { worker_.drain(); }

} // namespace ramus::app
