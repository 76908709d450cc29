// Workspace: a document and the work that goes on behind it. Files are read and surfaces computed on worker threads;
// results arrive in update(), on the owner's thread, which waits a frame or two at most. The cones are there as soon as
// the tree is; the surface of the session's options, without its hidden branches, replaces them when it is ready, and
// follows. A file that cannot be read leaves everything as it was. No GL, no window.
#pragma once

#include "app/assets/assets.h"
#include "app/session/document.h"
#include "app/storage/autosave.h"
#include "app/workspace/compared_surfaces.h"
#include "app/workspace/context_reader.h"
#include "app/workspace/loaded_tree.h"
#include "app/workspace/surface_maker.h"
#include "core/base/error.h"
#include "core/base/worker.h"
#include "core/io/trees/tree_file.h"

#include <chrono>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>

namespace ramus::app {

class Workspace {
public:
    // `wake` is called from other threads when update() has something to do.
    explicit Workspace(std::function<void()> wake);

    void open(const std::filesystem::path& path);
    void recover(const autosave::Snapshot& snapshot);
    // What was loaded elsewhere, at once.
    void adopt(LoadedTree loaded, const std::filesystem::path& path);
    io::ReadOptions reading; // of files that are opened from now on

    // A file that was read while work on the tree before went on, and that work is not saved: it waits to be let in, or
    // to be sent away.
    [[nodiscard]] bool arrival_waits() const { return arrival_ != nullptr; }
    void let_in();
    void send_away() { arrival_.reset(); }

    void cancel_work();
    // Takes what the workers finished and starts what the session needs. True when something changed. Call it again
    // after the picture has been drawn.
    bool update();

    Document document;
    // What belongs to the document, as of the last refresh(); and brought up to it, and to the options that are tried.
    Assets assets;
    const Assets& current_assets();

    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return document.facts(); }
    [[nodiscard]] const ReadySurface& shown() const { return shown_; }
    // Whether what is shown is the surface of the session as it is now.
    [[nodiscard]] bool surface_ready() const {
        return shown_.mesh && !shown_.provisional && shown_.request == surface_request(document.marks());
    }
    // What is shown, and the surfaces that it is compared with, as far as they are there: those that are being made are
    // as they were before.
    [[nodiscard]] ShownSurfaces surfaces() const;
    // Whether a surface to compare with is being made, or about to be.
    [[nodiscard]] bool comparing() const;
    // Why one cannot be had; empty: all can.
    [[nodiscard]] const std::string& comparison_problem() const { return comparison_problem_; }
    // Waits a moment for the preview of the surface that is shown, when it is about to come. For who draws so slowly
    // that the surface itself would take longer.
    void await_preview();
    // Options that are being tried, while a slider is held, say: the surface follows them instead of the session's.
    void try_options(const std::optional<mesh::SurfaceOptions>& options) { tried_ = options; }
    [[nodiscard]] const std::optional<mesh::SurfaceOptions>& tried_options() const { return tried_; }
    // Whether a surface is on its way, or about to be, that shall take the place of the one that is shown.
    [[nodiscard]] bool surface_awaited() const {
        return shown_.mesh && problem_.empty() && (shown_.provisional || shown_.request != request());
    }

    [[nodiscard]] bool busy() const {
        return loader_.busy() || mesher_.busy() || planner_.busy() || comparer_.busy() || context.busy();
    }
    [[nodiscard]] std::string activity() const; // "Reading liver.swc", "Computing the surface"; empty when idle
    [[nodiscard]] float progress() const;       // of that, 0 to 1

    // Set when a tree came in since the last call: the window fits its camera then.
    struct Opened {
        std::filesystem::path path; // as it was asked for: a session's own name
        bool has_camera = false;
        bool recovered = false;
    };
    [[nodiscard]] std::optional<Opened> take_opened() { return std::exchange(opened_, std::nullopt); }
    [[nodiscard]] std::optional<Error> take_error();
    ContextReader context; // what is shown beside the tree
    // The surface of these options could not be made, or its making was cancelled; the cones or an older surface are
    // shown. Empty otherwise.
    [[nodiscard]] const std::string& surface_problem() const { return problem_; }
    void retry_surface();

private:
    static constexpr std::size_t kKeptSurfaces = 3;
    // A branch that is hidden is gone from the surface within a frame or two: then the next picture is the right one.
    static constexpr std::chrono::milliseconds kPatience{25};
    static constexpr std::chrono::milliseconds kPreviewPatience{80};
    static constexpr std::chrono::milliseconds kShort{500}; // what is being made is let finish

    void load_with(const std::filesystem::path& path, std::function<Result<LoadedTree>(Job&)> load);
    [[nodiscard]] SurfaceRequest request() const;
    void take(ReadySurface surface);
    void make_next(const SurfaceRequest& request);
    [[nodiscard]] bool worth_finishing(const SurfaceRequest& request) const;
    void start_surface();
    void start_plan();
    void start_comparison();
    [[nodiscard]] std::optional<ComparedRequest> missing_surface() const;

    ReadySurface shown_;
    std::deque<ReadySurface> kept_; // newest first: undo finds the surface that was there before
    std::optional<mesh::SurfaceOptions> tried_;
    std::optional<SurfaceRequest> wanted_;
    std::shared_ptr<SurfaceMaker> maker_;
    std::chrono::steady_clock::time_point started_; // the mesher's task
    bool refining_ = false;                         // it makes a surface whose preview is shown
    std::string problem_;
    std::optional<Opened> opened_;
    std::deque<Error> errors_;
    std::shared_ptr<LoadedTree> arrival_;
    std::filesystem::path arrival_path_;
    std::vector<ComparedSurface> compared_;             // one a kind
    std::optional<ComparedRequest> comparing_, failed_; // what is being made; what could not be
    std::string comparison_problem_;                    // why
    bool changed_ = false;
    bool awaited_ = false;                        // the preview of what is shown
    bool first_is_coming_ = false;                // the loader, which read the tree, is at its first surface
    bool just_shown_ = false;                     // a picture that something better shall follow
    Worker loader_, mesher_, planner_, comparer_; // last: their threads end first
};

} // namespace ramus::app
