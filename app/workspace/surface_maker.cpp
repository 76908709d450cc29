#include "app/workspace/surface_maker.h"

#include "core/base/free_in_background.h"
#include "core/base/memory.h"
#include "core/base/run_limited.h"
#include "core/base/stopwatch.h"
#include "core/mesh/check_kernel.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "core/tree/prepare.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <iterator>
#include <thread>

namespace ramus::app {

namespace {

constexpr int kPreviewDetail = 6;
constexpr std::uint64_t kPreviewFrom = 150'000; // triangles: below, even a software rasteriser keeps up

} // namespace

SurfaceRequest surface_request(const Marks& marks) {
    return {marks.options, branches_in_state(marks, tree::BranchState::kHidden)};
}

std::vector<std::uint8_t> hidden_flags(std::span<const int> hidden, std::size_t branch_count) {
    std::vector<std::uint8_t> flags;
    if (!hidden.empty()) flags.resize(branch_count, 0);
    for (const int branch : hidden)
        if (static_cast<std::size_t>(branch) < branch_count) flags[static_cast<std::size_t>(branch)] = 1;
    return flags;
}

std::shared_ptr<const render::PagedMesh> paged(const mesh::TriangleMesh& mesh, const tree::VesselTree& tree,
                                               std::shared_ptr<const field::SurfaceProjector> projector) {
    render::PagedMesh made(mesh, render::bounds_of(tree).centre());
    made.set_projector(std::move(projector));
    return render::shared(std::move(made));
}

Result<ReadySurface> make_ready(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job) {
    const Stopwatch watch;
    const auto hidden = hidden_flags(request.hidden, tree.branches.size());
    ReadySurface ready{.request = request, .mesh = nullptr, .preview = nullptr};
    if (!hidden.empty() && std::ranges::find(hidden, 0) == hidden.end()) {
        ready.mesh = paged({}, tree);
    } else {
        RAMUS_TRY(made, mesh::make_surface(tree, as_drawn(request.options), job, hidden));
        ready.mesh = paged(made.mesh, tree, made.projector);
    }
    ready.seconds = watch.seconds();
    return ready;
}

// The picture stands for a moment: of a large tree it is a rough one, or the surface would be there before it.
Result<ReadySurface> first_cones(const tree::VesselTree& tree, const SurfaceRequest& wanted, Job& job) {
    constexpr std::size_t kRoughFrom = 2000; // segments
    constexpr int kRough = 6;
    constexpr double kRoughSpacing = 4.0; // radii
    SurfaceRequest request = wanted;
    mesh::SurfaceOptions& options = request.options;
    options.method = mesh::Method::kTruncatedCones;
    const bool rough = tree.segment_count() > kRoughFrom;
    if (rough) options.detail = std::min(options.detail, kRough), options.smooth_passes = 0;
    auto cones = make_ready(rough ? tree::thinned(tree, kRoughSpacing) : tree, request, job);
    if (cones) cones->provisional = true;
    return cones;
}

Result<ReadySurface> SurfaceMaker::next(const SurfaceRequest& request, Job& job) {
    const std::lock_guard turn(turn_);
    const auto give_up = [&] {
        surface_ = {};
        preview_ = {};
        surface_of_.reset();
        preview_of_.reset();
        return Error{"not enough memory for this surface", {}, "lower --detail, raise --cell or prune the tree"};
    };
    return run_limited(request.options.threads, give_up, [&] {
        return request.options.method == mesh::Method::kTruncatedCones ? next_cones(request, job)
                                                                       : next_surface(request, job);
    });
}

Result<ReadySurface> SurfaceMaker::next_cones(const SurfaceRequest& request, Job& job) const {
    auto cones = make_ready(*tree_, request, job);
    if (!cones || cones->mesh->triangle_count() < kPreviewFrom) return cones;
    SurfaceRequest rough = request;
    rough.options.detail = std::min(request.options.detail, kPreviewDetail);
    RAMUS_TRY(preview, make_ready(*tree_, rough, job));
    cones->preview = preview.mesh;
    return cones;
}

bool SurfaceMaker::changes_much(const SurfaceRequest& request) const {
    if (!surface_of_ || surface_of_->options != request.options) return true;
    std::vector<int> changed;
    std::ranges::set_symmetric_difference(surface_of_->hidden, request.hidden, std::back_inserter(changed));
    return 4 * changed.size() > tree_->branches.size();
}

Result<ReadySurface> SurfaceMaker::next_surface(const SurfaceRequest& request, Job& job) {
    const Stopwatch watch;
    if (auto takes = mesh::check_kernel(request.options); !takes) return tl::unexpected(takes.error());
    if (!field_ || field_options_ != request.options) {
        RAMUS_TRY(made, mesh::make_tree_field(*tree_, as_drawn(request.options)));
        field_ = std::move(made);
        field_options_ = request.options;
    }
    const auto hidden = hidden_flags(request.hidden, tree_->branches.size());
    const std::vector<mesh::SystemField> systems = mesh::fields_by_system(*tree_, field_->field, hidden);

    // What changes much is seen in the preview first; what changes little is soon there, and its preview comes after.
    mesh::PolygonizeOptions options;
    options.memory_bytes = static_cast<double>(request.options.memory_bytes);
    const bool previews = request.options.detail > kPreviewDetail;
    const bool preview_first = previews && preview_of_ != request && changes_much(request);
    if (preview_first || (previews && preview_of_ != request && surface_of_ == request)) {
        options.detail = kPreviewDetail;
        preview_of_.reset();
        if (auto made = follow(preview_, systems, options, job); !made) return tl::unexpected(made.error());
        preview_of_ = request;
    }
    if (!preview_first && surface_of_ != request) {
        options.detail = request.options.detail;
        options.cell_mm = request.options.cell_mm;
        surface_of_.reset();
        if (auto made = follow(surface_, systems, options, job); !made) return tl::unexpected(made.error());
        // A surface rarely has other loops or pieces than its tree; then it is shown with those of the tree.
        if (mesh::row_of(request.options.blend).separates && surface_.current->triangle_count() > 0) {
            const double memory = memory_left(static_cast<double>(request.options.memory_bytes));
            if (const auto matched = surface_.surface.match(systems, field_->tree, memory, job))
                surface_.current = paged(*matched, *tree_, surface_.surface.projector());
        }
        if (job.cancelled()) return fail("cancelled");
        surface_of_ = request;
    }
    ReadySurface ready;
    ready.request = request;
    ready.mesh = preview_first ? preview_.current : surface_.current;
    ready.provisional = preview_first;
    if (preview_first || ready.mesh->triangle_count() >= kPreviewFrom) {
        if (preview_of_ == request) ready.preview = preview_.current;
        ready.preview_follows = previews && !ready.preview;
    }
    ready.seconds = watch.seconds();
    return ready;
}

Result<void> SurfaceMaker::follow(Followed& followed, std::span<const mesh::SystemField> systems,
                                  const mesh::PolygonizeOptions& options, Job& job) const {
    if (systems.front().field.skeleton().segments().empty())
        return fail("the tree has no segments", {}, "nothing to make a surface of");
    if (std::ranges::none_of(systems, &mesh::SystemField::visible)) {
        // What is followed stays where it is: what comes next is likely to be near that.
        followed.current = paged({}, *tree_);
        return {};
    }
    if (auto updated = followed.surface.update(systems, options, job); !updated) {
        followed.mesh = nullptr;
        return updated;
    }
    if (followed.surface.in_place())
        edit_pages(followed);
    else
        followed.mesh = paged(followed.surface.together(systems), *tree_, followed.surface.projector());
    followed.current = followed.mesh;
    if (followed.mesh->triangle_count() == 0) return mesh::empty_surface(options.cell_mm);
    return {};
}

void SurfaceMaker::edit_pages(Followed& followed) const {
    const mesh::SurfaceEdit edit = followed.surface.take_edit();
    const mesh::TriangleMesh& slots = followed.surface.slots();
    // What polygonizing worked in is as large as the pages, and is given back before they are made.
    if (edit.whole && slots.triangles.size() >= kWorthReleasing) release_unused_memory();
    if (!followed.mesh) {
        followed.mesh = paged(slots, *tree_, followed.surface.projector());
    } else if (edit.whole || !edit.vertices.empty() || !edit.triangles.empty()) {
        render::PagedMesh edited = followed.mesh->edited(slots, edit);
        edited.set_projector(followed.surface.projector());
        followed.mesh = render::shared(std::move(edited));
    }
}

void SurfaceFollower::open(std::shared_ptr<SurfaceMaker> maker, ReadySurface shown) {
    worker_.cancel();
    cones_worker_.cancel();
    // The maker before may hold gigabytes; the thread drops the last reference to it.
    if (const auto before = std::exchange(maker_, std::move(maker))) free_in_background([before] {});
    shown_ = std::move(shown);
    cached_.clear();
    requested_.reset();
    problem_.clear();
    just_shown_ = true;
    changed_ = true;
}

void SurfaceFollower::change_tree(const std::shared_ptr<const tree::VesselTree>& tree, const SurfaceRequest& request) {
    open(std::make_shared<SurfaceMaker>(tree), {});
    follow(request, false);
    // Made meanwhile, and mostly in vain: without them the surface is waited for.
    const auto until = std::chrono::steady_clock::now() + kEditPatience;
    cones_worker_.start("Computing the surface", [this, tree, request, until](Job& job, const Worker::Post& post) {
        const auto made = first_cones(*tree, request, job);
        constexpr std::chrono::milliseconds kNap{5};
        while (!job.cancelled() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(kNap);
        if (made) post([this, made] { show(*made); });
    });
}

void SurfaceFollower::await_tree() {
    constexpr std::chrono::milliseconds kNap{5};
    while (between_trees()) {
        worker_.wait(kNap);
        drain();
    }
}

void SurfaceFollower::arrive(const Result<ReadySurface>& made) {
    if (made)
        show(*made);
    else
        problem_ = made.error().message();
    changed_ = true;
}

void SurfaceFollower::show(ReadySurface surface) {
    cones_worker_.cancel(); // something is there
    shown_ = std::move(surface);
    changed_ = true;
    just_shown_ = shown_.provisional;
    preview_awaited_ = false;
    if (shown_.provisional) return;
    std::erase_if(cached_, [&](const ReadySurface& cached) { return cached.request == shown_.request; });
    cached_.push_front(shown_);
    if (cached_.size() > kCachedSurfaces) cached_.pop_back();
    const auto bytes_beside = [](const ReadySurface& one, const ReadySurface& other) {
        const auto of = [](const auto& mesh, const auto& with) { return mesh && with ? mesh->bytes_beside(*with) : 0; };
        return of(one.mesh, other.mesh) + of(one.preview, other.preview);
    };
    std::size_t bytes = 0;
    for (std::size_t i = 1; i < cached_.size(); ++i) {
        bytes += bytes_beside(cached_[i], cached_[i - 1]);
        if (bytes > kCachedBytes) cached_.resize(i);
    }
}

void SurfaceFollower::follow(const SurfaceRequest& request, bool tried) {
    if (requested_ == request) {
        // What is only being tried is about to change: its preview is enough.
        const bool refine = shown_.provisional && shown_.request == request && !tried;
        if (refine && !worker_.busy() && problem_.empty()) {
            refining_ = true;
            make_next(request);
        }
        return;
    }
    if (worker_.busy() && worth_finishing(request)) return;
    const bool small_change =
        requested_ && requested_->options == request.options && shown_.mesh && !shown_.provisional;
    refining_ = false;
    requested_ = request;
    problem_.clear();
    worker_.cancel();
    changed_ = true;
    if (shown_.mesh && !shown_.provisional && shown_.request == request) return;
    for (const ReadySurface& surface : cached_) {
        if (surface.request != request) continue;
        shown_ = surface;
        return;
    }
    make_next(request);
    if (!small_change) return;
    worker_.wait(kPatience);
    worker_.drain();
}

void SurfaceFollower::await_preview() {
    if (!shown_.preview_follows || !worker_.busy() || std::exchange(preview_awaited_, true)) return;
    worker_.wait(kPreviewPatience);
    worker_.drain();
}

// When only other branches are hidden, what is being made is the way to what is requested now. And while somebody drags
// a slider, previews that never get finished would show nothing.
bool SurfaceFollower::worth_finishing(const SurfaceRequest& request) const {
    if (requested_ && requested_->options == request.options) return true;
    return !refining_ && std::chrono::steady_clock::now() - started_ < kShort;
}

void SurfaceFollower::make_next(const SurfaceRequest& request) {
    started_ = std::chrono::steady_clock::now();
    worker_.start("Computing the surface", [this, request, maker = maker_](Job& job, const Worker::Post& post) {
        for (bool more = true; more;) {
            const auto made = maker->next(request, job);
            if (job.cancelled()) return;
            more = made && made->preview_follows;
            post([this, made] { arrive(made); });
        }
    });
}

void SurfaceFollower::give_up(std::string why) {
    worker_.cancel();
    problem_ = std::move(why);
}

void SurfaceFollower::give_up(const SurfaceRequest& request, std::string why) {
    requested_ = request;
    give_up(std::move(why));
}

std::string SurfaceFollower::take_failure() {
    std::string failure = worker_.take_failure();
    if (failure.empty()) return cones_worker_.take_failure();
    problem_ = "the work was given up: " + failure;
    return failure;
}

} // namespace ramus::app
