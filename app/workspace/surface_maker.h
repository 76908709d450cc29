// SurfaceMaker: makes the surface of one tree for the window and follows what becomes of it. Hiding and showing
// branches recompute what they touch; whatever changes everything gives a preview first, the same surface with fewer
// triangles, which also stands in while the view moves. Any thread may ask; they take turns. What it hands out is
// immutable.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"
#include "core/mesh/followed_surface.h"
#include "render/scene/paged_mesh.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

// Everything that a surface depends on beside its tree.
struct SurfaceRequest {
    mesh::SurfaceOptions options;
    std::vector<int> hidden; // branch ids, ascending
    bool operator==(const SurfaceRequest&) const = default;
};

[[nodiscard]] SurfaceRequest surface_request(const Marks& marks);
// By branch id, not 0: hidden. Empty when none is.
[[nodiscard]] std::vector<std::uint8_t> hidden_flags(std::span<const int> hidden, std::size_t branch_count);

// The options under which surfaces are made that are for pictures alone.
[[nodiscard]] inline mesh::SurfaceOptions as_drawn(mesh::SurfaceOptions options) {
    options.rims = field::Rims::kOverlapping;
    return options;
}

// A mesh of the tree as it is drawn: all of them have the same origin. `drawn`: what it is a mesh of.
[[nodiscard]] std::shared_ptr<const render::PagedMesh>
paged(const mesh::TriangleMesh& mesh, const tree::VesselTree& tree,
      std::shared_ptr<const field::SurfaceProjector> projector = {});

// A surface that was computed, and what it cost.
struct ReadySurface {
    SurfaceRequest request;
    std::shared_ptr<const render::PagedMesh> mesh;
    std::shared_ptr<const render::PagedMesh> preview; // for while the view moves; null: none, or not yet
    double seconds = 0.0;
    bool provisional = false; // the preview (or rough cones) in place of the surface
    bool preview_follows = false;
};

// The surface from nothing; without any triangle when every branch is hidden.
[[nodiscard]] Result<ReadySurface> make_ready(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job);

// Cones of the tree, rough ones of a large tree, as long as there is no surface: they take some milliseconds.
[[nodiscard]] Result<ReadySurface> first_cones(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job);

class SurfaceMaker {
public:
    explicit SurfaceMaker(std::shared_ptr<const tree::VesselTree> tree) : tree_(std::move(tree)) {}

    // The next better picture of what is asked for. While it is provisional or its preview follows, ask again.
    [[nodiscard]] Result<ReadySurface> next(const SurfaceRequest& request, Job& job);

private:
    using Paged = std::shared_ptr<const render::PagedMesh>;
    struct Followed {
        mesh::FollowedSurface surface;
        Paged mesh;    // of the surface's state
        Paged current; // what was asked for last
    };
    [[nodiscard]] Result<ReadySurface> next_cones(const SurfaceRequest& request, Job& job) const;
    [[nodiscard]] Result<ReadySurface> next_surface(const SurfaceRequest& request, Job& job);
    [[nodiscard]] Result<void> follow(Followed& followed, std::span<const mesh::SystemField> systems,
                                      const mesh::PolygonizeOptions& options, Job& job) const;
    void edit_pages(Followed& followed) const;
    [[nodiscard]] bool changes_much(const SurfaceRequest& request) const;

    std::shared_ptr<const tree::VesselTree> tree_;
    std::mutex turn_;                      // guards what follows
    std::optional<mesh::TreeField> field_; // under field_options_
    mesh::SurfaceOptions field_options_;
    std::optional<SurfaceRequest> surface_of_, preview_of_; // what the two are up to
    Followed surface_, preview_;
};

// SurfaceFollower: the surface that is shown, which follows what is requested. It is made on a worker, better and
// better; a few surfaces are cached, so that undo finds the one that was there before. For one thread, its owner's.
class SurfaceFollower {
public:
    explicit SurfaceFollower(const std::function<void()>& wake) : cones_worker_(wake), worker_(wake) {}

    // Another tree, and what is shown of it at first.
    void open(std::shared_ptr<SurfaceMaker> maker, ReadySurface shown);
    // The same vessels, edited: the new surface where it is soon there, cones until it is where not. Until either is
    // there nothing is shown.
    void change_tree(const std::shared_ptr<const tree::VesselTree>& tree, const SurfaceRequest& request);
    void show(ReadySurface surface); // that was made elsewhere
    // Whether what is to be shown of an edited tree is on its way, and waiting for it.
    [[nodiscard]] bool between_trees() const { return !shown_.mesh && (cones_worker_.busy() || worker_.busy()); }
    void await_tree();
    // Takes what was made, and nothing more.
    void drain() {
        worker_.drain();
        cones_worker_.drain();
    }
    // Starts what is requested; of what is only being tried (while a slider is held) a preview is enough. Waits a
    // moment for a small change.
    void follow(const SurfaceRequest& request, bool tried);
    // Waits a moment for the preview of what is shown, when it is about to come.
    void await_preview();

    [[nodiscard]] const ReadySurface& shown() const { return shown_; }
    // Whether something is on its way, or about to be, that shall take the place of what is shown.
    [[nodiscard]] bool awaited(const SurfaceRequest& request) const {
        return shown_.mesh && problem_.empty() && (shown_.provisional || shown_.request != request);
    }
    // Why what was requested could not be made; empty: it could, or is being made.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    // Nothing more is made for what was requested last, or for this request, until something else is or retry().
    void give_up(std::string why);
    void give_up(const SurfaceRequest& request, std::string why);
    void retry() { requested_.reset(); }
    // Whether something provisional came since the last call: it is drawn before something better is begun, as both
    // want the whole machine.
    [[nodiscard]] bool take_just_shown() { return std::exchange(just_shown_, false); }
    [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }

    [[nodiscard]] const Worker& worker() const { return worker_; }
    [[nodiscard]] const Worker& cones_worker() const { return cones_worker_; }
    // Why the last task ended by an exception, once; empty: none did. Where it was the cones' the surface still comes.
    [[nodiscard]] std::string take_failure();

private:
    static constexpr std::size_t kCachedSurfaces = 3;
    // Beside the one that is shown. Surfaces that differ in branches that are hidden share nearly all; others of a
    // large tree would take more than all else.
    static constexpr std::size_t kCachedBytes = std::size_t{1} << 30;
    // A branch that is hidden is gone from the surface within a frame or two: then the next picture is the right one.
    static constexpr std::chrono::milliseconds kPatience{25};
    static constexpr std::chrono::milliseconds kPreviewPatience{80};
    static constexpr std::chrono::milliseconds kEditPatience{120}; // no cones flash up between two surfaces
    static constexpr std::chrono::milliseconds kShort{500};        // what is being made is let finish

    void arrive(const Result<ReadySurface>& made);
    void make_next(const SurfaceRequest& request);
    [[nodiscard]] bool worth_finishing(const SurfaceRequest& request) const;

    std::shared_ptr<SurfaceMaker> maker_;
    ReadySurface shown_;
    std::deque<ReadySurface> cached_; // newest first
    std::optional<SurfaceRequest> requested_;
    std::chrono::steady_clock::time_point started_; // the worker's task
    bool refining_ = false;                         // it makes a surface whose preview is shown
    bool preview_awaited_ = false;                  // of what is shown: waited for once
    bool just_shown_ = false;                       // something provisional, not drawn yet
    bool changed_ = false;
    std::string problem_;
    Worker cones_worker_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
