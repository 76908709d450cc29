#include "app/surface_maker.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <new>
#include <oneapi/tbb/task_arena.h>

namespace ramus::app {

namespace {

constexpr int kPreviewDetail = 6;
constexpr std::uint64_t kPreviewFrom = 150'000; // triangles: below, even a software rasteriser keeps up

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

render::Box box_of(const tree::VesselTree& tree) {
    render::Box box;
    for (const tree::Point& point : tree.points) box.include(point.position);
    return box;
}

} // namespace

SurfaceRequest surface_request(const Marks& marks) {
    return {marks.options, branches_in_state(marks, render::BranchState::kHidden)};
}

std::vector<std::uint8_t> hidden_flags(std::span<const int> hidden, std::size_t branch_count) {
    std::vector<std::uint8_t> flags;
    if (!hidden.empty()) flags.resize(branch_count, 0);
    for (const int branch : hidden)
        if (static_cast<std::size_t>(branch) < branch_count) flags[static_cast<std::size_t>(branch)] = 1;
    return flags;
}

std::shared_ptr<const render::PagedMesh> paged(const mesh::TriangleMesh& mesh, const tree::VesselTree& tree) {
    return std::make_shared<const render::PagedMesh>(mesh, box_of(tree).centre());
}

Result<ReadySurface> make_ready(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job) {
    const auto start = std::chrono::steady_clock::now();
    const auto hidden = hidden_flags(request.hidden, tree.branches.size());
    ReadySurface ready{.request = request, .mesh = nullptr, .preview = nullptr};
    if (!hidden.empty() && std::ranges::find(hidden, 0) == hidden.end()) {
        ready.mesh = paged({}, tree);
    } else {
        const auto made = mesh::make_surface(tree, request.options, job, hidden);
        if (!made) return tl::unexpected(made.error());
        ready.mesh = paged(made->mesh, tree);
    }
    ready.seconds = seconds_since(start);
    return ready;
}

Result<void> SurfaceMaker::make(const SurfaceRequest& request, Job& job, const Show& show) {
    const auto work = [&] {
        return request.options.method == mesh::Method::kTruncatedCones ? make_cones(request, job, show)
                                                                       : make_surface(request, job, show);
    };
    try {
        if (request.options.threads <= 0) return work();
        tbb::task_arena arena(request.options.threads);
        return arena.execute(work);
    } catch (const std::bad_alloc&) {
        surface_ = {};
        preview_ = {};
        return fail("not enough memory for this surface", {}, "lower --detail, raise --cell or prune the tree");
    }
}

Result<void> SurfaceMaker::make_cones(const SurfaceRequest& request, Job& job, const Show& show) {
    auto cones = make_ready(*tree_, request, job);
    if (!cones) return tl::unexpected(cones.error());
    show(*cones);
    if (cones->mesh->triangle_count() < kPreviewFrom) return {};
    SurfaceRequest rough = request;
    rough.options.detail = std::min(request.options.detail, kPreviewDetail);
    const auto preview = make_ready(*tree_, rough, job);
    if (!preview) return tl::unexpected(preview.error());
    cones->preview = preview->mesh;
    show(std::move(*cones));
    return {};
}

bool SurfaceMaker::changes_much(const SurfaceRequest& request) const {
    if (!made_ || made_->options != request.options || !surface_.mesh) return true;
    std::vector<int> changed;
    std::ranges::set_symmetric_difference(made_->hidden, request.hidden, std::back_inserter(changed));
    return 4 * changed.size() > tree_->branches.size();
}

Result<void> SurfaceMaker::make_surface(const SurfaceRequest& request, Job& job, const Show& show) {
    const auto start = std::chrono::steady_clock::now();
    const bool preview_first = changes_much(request) && request.options.detail > kPreviewDetail;
    if (!field_ || made_->options != request.options) field_ = mesh::make_field(*tree_, request.options, {});
    made_ = request;
    const auto hidden = hidden_flags(request.hidden, tree_->branches.size());
    const field::ConvolutionField field = hidden.empty() ? *field_ : field_->without(hidden);
    mesh::PolygonizeOptions options;
    options.detail = kPreviewDetail;
    ReadySurface ready{.request = request, .mesh = nullptr, .preview = nullptr, .provisional = true};
    const auto make_preview = [&]() -> Result<void> {
        auto made = follow(preview_, field, options, job);
        if (!made) return tl::unexpected(made.error());
        ready.preview = std::move(*made);
        return {};
    };
    if (preview_first) {
        if (auto made = make_preview(); !made) return made;
        ready.mesh = ready.preview;
        ready.seconds = seconds_since(start);
        show(ready);
    }
    mesh::PolygonizeOptions fine;
    fine.detail = request.options.detail;
    fine.cell_mm = request.options.cell_mm;
    auto made = follow(surface_, field, fine, job);
    if (!made) return tl::unexpected(made.error());
    ready.mesh = std::move(*made);
    ready.provisional = false;
    ready.seconds = seconds_since(start);
    if (ready.mesh->triangle_count() < kPreviewFrom) ready.preview = nullptr;
    show(ready);
    if (preview_first || ready.mesh->triangle_count() < kPreviewFrom) return {};
    if (auto also = make_preview(); !also) return also;
    show(std::move(ready));
    return {};
}

Result<SurfaceMaker::Paged> SurfaceMaker::follow(Followed& followed, const field::ConvolutionField& field,
                                                 const mesh::PolygonizeOptions& options, Job& job) {
    if (field.segments().empty()) return fail("the tree has no segments", {}, "nothing to make a surface of");
    // The polygonizer stays where it is: what comes next is likely to be near that.
    if (field.present().empty()) return paged({}, *tree_);
    if (auto updated = followed.polygonizer.update(field, options, job); !updated) {
        followed.mesh = nullptr;
        return tl::unexpected(updated.error());
    }
    const mesh::SurfaceEdit edit = followed.polygonizer.take_edit();
    const mesh::TriangleMesh& slots = followed.polygonizer.slots();
    if (!followed.mesh)
        followed.mesh = paged(slots, *tree_);
    else if (edit.whole || !edit.vertices.empty() || !edit.triangles.empty())
        followed.mesh = std::make_shared<const render::PagedMesh>(followed.mesh->edited(slots, edit));
    return followed.mesh;
}

} // namespace ramus::app
