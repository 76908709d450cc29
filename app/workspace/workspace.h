// Workspace: a document and the work that goes on behind it. Files are read and surfaces computed on worker threads;
// results arrive in update(), on the owner's thread, which waits a frame or two at most. The cones are there as soon as
// the tree is; the surface of the session's options, without its hidden branches, replaces them when it is ready, and
// follows. A file that cannot be read leaves everything as it was. No GL, no window.
//
// The tree is loaded and its surface made by objects of their own; all other work is an entry of the registry
// (app/workspace/background_works.h).
#pragma once

#include "app/assets/assets.h"
#include "app/session/document.h"
#include "app/storage/autosave.h"
#include "app/workspace/background_works.h"
#include "app/workspace/compared_surfaces.h"
#include "app/workspace/loaded_tree.h"
#include "app/workspace/surface_maker.h"
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
    // How files are read that are opened from now on; wins over what sessions say.
    [[nodiscard]] const io::ReadOptions& reading() const { return reading_; }
    void set_reading(io::ReadOptions reading) { reading_ = std::move(reading); }

    // A file was read while work on the tree before went on, and that work is not saved: the file waits until it is
    // accepted or discarded.
    [[nodiscard]] bool arrival_waits() const { return arrival_.has_value(); }
    void accept_arrival();
    void discard_arrival() { arrival_.reset(); }

    void cancel_work();
    // Takes what the workers finished and starts what the session needs. True when something changed. Call it again
    // after the picture has been drawn.
    bool update();

    [[nodiscard]] Document& document() { return document_; }
    [[nodiscard]] const Document& document() const { return document_; }
    // What belongs to the document, as of the last refresh(); and brought up to it, and to the options that are tried.
    [[nodiscard]] Assets& assets() { return assets_; }
    [[nodiscard]] const Assets& assets() const { return assets_; }
    const Assets& current_assets();

    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return document_.facts(); }
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
        return tree_shown_ == document_.tree() && shown().mesh && !shown().provisional &&
               shown().request == surface_request(document_.marks());
    }
    // Whether all is there that the document shows, a tree's surface or what is shown without one.
    [[nodiscard]] bool all_shown() const {
        return document_.tree() ? surface_ready() && !work(WorkKind::kCenterlines).worker().busy()
                                : document_.has_scene() && !awaited(WorkKind::kContext);
    }
    // What is shown, and the surfaces that it is compared with, as far as they are there: those that are being made are
    // as they were before.
    [[nodiscard]] ShownSurfaces surfaces() const;
    // Work behind the window: whether something of a kind is being made, or about to be; why it cannot be had, which is
    // empty where it can; trying it again; and how far it is, 0 to 1.
    [[nodiscard]] bool awaited(WorkKind kind) const { return work(kind).awaited(view(), assets_); }
    [[nodiscard]] std::string problem(WorkKind kind) const { return work(kind).problem(); }
    void retry(WorkKind kind);
    [[nodiscard]] float progress(WorkKind kind) const { return work(kind).worker().progress(); }
    // The surface is held against its tree (app/assets/validation.h) where that is wanted: in its panel. Contacts are
    // looked for at once where they are wanted: listed, or marked in the picture. Cones are what the processor draws:
    // wanted where there is no graphics card.
    void want_validation(bool wanted) { validation_wanted_ = wanted; }
    void want_contacts(bool wanted) { contacts_wanted_ = wanted; }
    void want_cones(bool wanted) { cones_wanted_ = wanted; }
    // Waits a moment for the preview of the surface that is shown, when it is about to come. For who draws so slowly
    // that the surface itself would take longer.
    void await_preview();
    // Options that are being tried, while a slider is held, say: the surface follows them instead of the session's.
    void try_options(const std::optional<mesh::SurfaceOptions>& options) { tried_ = options; }
    [[nodiscard]] const std::optional<mesh::SurfaceOptions>& tried_options() const { return tried_; }
    // Whether a surface is on its way, or about to be, that takes the place of the one that is shown.
    [[nodiscard]] bool surface_awaited() const { return document_.tree() && surface_.awaited(request()); }
    // The surface of these options could not be made, or its making was cancelled; the cones or an older surface are
    // shown. Empty otherwise.
    [[nodiscard]] const std::string& surface_problem() const { return surface_.problem(); }
    void retry_surface();

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
    [[nodiscard]] WorkView view() const;
    [[nodiscard]] const BackgroundWork& work(WorkKind kind) const { return *works_[static_cast<std::size_t>(kind)]; }
    // Of the tree and its surface.
    [[nodiscard]] std::array<const Worker*, 3> surface_workers() const {
        return {&loader_.worker(), &surface_.worker(), &surface_.cones_worker()};
    }
    [[nodiscard]] const BackgroundWork* busy_work() const; // the first that is named; null: none

    Document document_;
    Assets assets_;
    io::ReadOptions reading_;
    std::shared_ptr<const tree::VesselTree> tree_shown_; // that the surfaces are of
    std::filesystem::path asked_for_;
    std::optional<mesh::SurfaceOptions> tried_;
    std::optional<Opened> opened_;
    std::deque<Error> errors_;
    Marks marks_before_loading_;
    std::optional<TreeLoader::Arrival> arrival_; // waits to be accepted
    bool contacts_wanted_ = false, validation_wanted_ = false, cones_wanted_ = false;
    bool changed_ = false;
    bool first_is_coming_ = false; // the loader, which read the tree, is at its first surface
    // Last: their threads end first.
    TreeLoader loader_;
    SurfaceFollower surface_;
    std::vector<ComparedSurface> compared_; // as far as they are there
    std::vector<std::unique_ptr<BackgroundWork>> works_;
};

} // namespace ramus::app
