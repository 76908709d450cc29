// Workspace: a document and the work that goes on behind it. Files are read and surfaces computed on worker threads;
// results arrive in update(), on the owner's thread, which waits a frame or two at most. The cones are there as soon as
// the tree is; the surface of the session's options, without its hidden branches, replaces them when it is ready, and
// follows. A file that cannot be read leaves everything as it was. No GL, no window.
//
// Each kind of work has its own object and thread: loading a tree, following with the surface, making surfaces to
// compare with, reading context, reading lesions and measuring distances to them, measuring how far the surface lies
// from another one, holding it against its tree, and looking for contacts.
#pragma once

#include "app/assets/assets.h"
#include "app/session/document.h"
#include "app/storage/autosave.h"
#include "app/workspace/centerlines_maker.h"
#include "app/workspace/compared_surfaces.h"
#include "app/workspace/cones_maker.h"
#include "app/workspace/context_reader.h"
#include "app/workspace/deviation_maker.h"
#include "app/workspace/loaded_tree.h"
#include "app/workspace/surface_maker.h"
#include "app/workspace/validation_maker.h"
#include "core/io/trees/tree_file.h"

#include <array>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>

namespace ramus::app {

class Workspace {
public:
    // `wake` is called from other threads when update() has something to do.
    explicit Workspace(const std::function<void()>& wake);

    void open(const std::filesystem::path& path);
    // The file that was opened last, whether it could be or not; in full.
    [[nodiscard]] const std::filesystem::path& asked_for() const { return asked_for_; }
    void recover(const autosave::Snapshot& snapshot);
    // What was loaded elsewhere, at once.
    void adopt(LoadedTree loaded, const std::filesystem::path& path);
    io::ReadOptions reading; // of files that are opened from now on; wins over what sessions say

    // A file that was read while work on the tree before went on, and that work is not saved: it waits to be let in, or
    // to be sent away.
    [[nodiscard]] bool arrival_waits() const { return arrival_.has_value(); }
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
    ContextReader context; // what is shown beside the tree

    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return document.facts(); }
    [[nodiscard]] const ReadySurface& shown() const { return surface_.shown(); }
    // After an edit of the tree, or reading its file in another way, or undoing either: what is shown and measured is
    // of the new tree from here on. update() does so too; who draws after commands in between asks for it. True when
    // the tree is another.
    bool follow_tree();
    // Whether what is to be shown of an edited tree is on its way: until it is there the picture stays as it is. And
    // waiting for it, for who keeps a picture.
    [[nodiscard]] bool between_trees() const;
    void await_tree();
    // Whether what is shown is the surface of the session as it is now.
    [[nodiscard]] bool surface_ready() const {
        return tree_shown_ == document.tree() && shown().mesh && !shown().provisional &&
               shown().request == surface_request(document.marks());
    }
    // Whether all is there that the document shows, a tree's surface or what is shown without one.
    [[nodiscard]] bool all_shown() const {
        return document.tree() ? surface_ready() && !centerlines_.worker().busy()
                               : document.has_scene() && !context.busy();
    }
    // What is shown, and the surfaces that it is compared with, as far as they are there: those that are being made are
    // as they were before.
    [[nodiscard]] ShownSurfaces surfaces() const;
    // Whether a surface to compare with is being made, or about to be.
    [[nodiscard]] bool comparing() const { return document.tree() && comparison_.awaited(document.marks()); }
    // Why one cannot be had; empty: all can.
    [[nodiscard]] std::string comparison_problem() const { return comparison_.problem(); }
    // Whether the distances that colours shall show are being measured, or about to be.
    [[nodiscard]] bool measuring_deviation() const { return missing_deviation().has_value(); }
    // The surface is held against its tree (app/assets/validation.h) where that is wanted: in its panel.
    void want_validation(bool wanted) { validation_wanted_ = wanted; }
    [[nodiscard]] bool validating() const {
        return validation_.worker().busy() || validation_.awaits(missing_validation());
    }
    // Why it cannot be, or that it was cancelled; empty: it can. And: it is tried again.
    [[nodiscard]] const std::string& validation_problem() const { return validation_.problem(); }
    [[nodiscard]] float validation_progress() const { return validation_.worker().progress(); }
    void retry_validation() { validation_.retry(); }
    // The tree's contacts are looked for when there is nothing better to do, and at once where they are wanted: listed,
    // or marked in the picture. Those of large trees only then.
    void want_contacts(bool wanted) { contacts_wanted_ = wanted; }
    // Whether they are being looked for, or about to be.
    [[nodiscard]] bool seeking_contacts() const;
    // Waits a moment for the preview of the surface that is shown, when it is about to come. For who draws so slowly
    // that the surface itself would take longer.
    void await_preview();
    // Options that are being tried, while a slider is held, say: the surface follows them instead of the session's.
    void try_options(const std::optional<mesh::SurfaceOptions>& options) { tried_ = options; }
    [[nodiscard]] const std::optional<mesh::SurfaceOptions>& tried_options() const { return tried_; }
    // Whether a surface is on its way, or about to be, that shall take the place of the one that is shown.
    [[nodiscard]] bool surface_awaited() const { return document.tree() && surface_.awaited(request()); }
    // The surface of these options could not be made, or its making was cancelled; the cones or an older surface are
    // shown. Empty otherwise.
    [[nodiscard]] const std::string& surface_problem() const { return surface_.problem(); }
    void retry_surface();
    // What pictures of the processor need is made ahead of them: where there is no graphics card.
    void want_cones(bool wanted) { cones_wanted_ = wanted; }

    [[nodiscard]] bool busy() const;
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

private:
    void load_with(const std::filesystem::path& path, TreeLoader::Read read);
    [[nodiscard]] SurfaceRequest request() const;
    void take_loaded();
    void take_failures();
    void follow_surface();
    void follow_lesions();
    void follow_contacts();
    void follow_cones();
    void follow_deviation();
    void follow_validation();
    [[nodiscard]] std::optional<ValidationOf> missing_validation() const;
    [[nodiscard]] std::optional<DeviationWork> missing_deviation() const;
    [[nodiscard]] bool contacts_due() const;
    static constexpr std::size_t kMostSoughtUnasked = 1'000'000; // points of the tree
    // Of the work that shows its progress, in the order in which it is named.
    [[nodiscard]] std::array<const Worker*, 7> workers() const {
        return {&loader_.worker(),     &surface_.worker(),   &surface_.cones_worker(), &lesions_,
                &comparison_.worker(), &deviation_.worker(), &validation_.worker()};
    }

    std::shared_ptr<const tree::VesselTree> tree_shown_; // that the surfaces are of
    std::filesystem::path asked_for_;
    std::optional<mesh::SurfaceOptions> tried_;
    std::optional<Opened> opened_;
    std::deque<Error> errors_;
    Marks marks_before_loading_;
    std::optional<TreeLoader::Arrival> arrival_; // waits to be let in
    PlannedMarks lesions_of_;                    // what is being measured
    std::optional<PlannedMarks> lesions_failed_; // not tried again
    // Of what contacts are being looked for, or could not be.
    std::pair<std::shared_ptr<const tree::VesselTree>, mesh::SurfaceOptions> contacts_of_;
    bool contacts_wanted_ = false, validation_wanted_ = false, cones_wanted_ = false;
    bool changed_ = false;
    bool first_is_coming_ = false; // the loader, which read the tree, is at its first surface
    // Last: their threads end first.
    TreeLoader loader_;
    SurfaceFollower surface_;
    ComparisonMaker comparison_;
    DeviationMaker deviation_;
    ValidationMaker validation_;
    Worker lesions_;
    Worker contacts_;
    CenterlinesMaker centerlines_;
    ConesMaker cones_;
};

} // namespace ramus::app
