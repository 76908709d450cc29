// Workspace: a document and its background work. Files are read and surfaces computed on worker threads; results arrive
// in update() on the owner's thread, which waits at most a frame or two. Cones are shown as soon as the tree is read;
// the surface of the session's options without hidden branches replaces them when it is ready, and follows changes. A
// file that cannot be read changes nothing. No GL, no window.
//
// Separate objects load the tree and make its surface; all other work is an entry of the registry
// (app/workspace/background_works.h). All calls must come from one thread, the owner's.
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
    // `wake`: called from other threads when update() has something to do. It must be thread-safe.
    explicit Workspace(const std::function<void()>& wake);

    // `how`: options for reading the file. They override those of say_reading(), which override a session's own.
    void open(const std::filesystem::path& path, const io::ReadOptions& how = {});
    // Absolute path of the file that was opened last, successfully or not.
    [[nodiscard]] const std::filesystem::path& asked_for() const { return asked_for_; }
    void recover(const autosave::Snapshot& snapshot);
    // Opens a tree that was loaded elsewhere, immediately.
    void adopt(LoadedTree loaded, const std::filesystem::path& path);
    // What the command line says about reading `file`; empty: about every file. A recovered session is read as it was.
    void say_reading(io::ReadOptions reading, const std::filesystem::path& file = {});
    [[nodiscard]] io::ReadOptions reading_of(const std::filesystem::path& file) const;

    // A file was read, but the current tree has unsaved work: the file waits to be accepted or discarded.
    [[nodiscard]] bool arrival_waits() const { return arrival_.has_value(); }
    void accept_arrival();
    void discard_arrival() { arrival_.reset(); }

    void cancel_work();
    // Takes finished results and starts missing work. True if something changed. Call again after drawing the picture.
    bool update();

    [[nodiscard]] Document& document() { return document_; }
    [[nodiscard]] const Document& document() const { return document_; }
    // The document's assets as of the last refresh(). current_assets() refreshes them first, for the trial options if
    // any.
    [[nodiscard]] Assets& assets() { return assets_; }
    [[nodiscard]] const Assets& assets() const { return assets_; }
    const Assets& current_assets();

    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return document_.facts(); }
    [[nodiscard]] const ReadySurface& shown() const { return surface_.shown(); }
    // Makes surface and measurements follow the document's tree after an edit, a reread, or their undo. update() does
    // this, too; call it when drawing between commands. True if the tree changed.
    bool follow_tree();
    // between_trees(): the first surface of an edited tree is being made, and the picture should stay unchanged until
    // then. await_tree(): waits for it, for callers that save pictures.
    [[nodiscard]] bool between_trees() const;
    void await_tree();
    // Whether the shown surface is that of the session's current state.
    [[nodiscard]] bool surface_ready() const {
        return tree_shown_ == document_.tree() && shown().mesh && !shown().provisional &&
               shown().request == surface_request(document_.marks());
    }
    // Whether everything that the document shows is ready: a tree's surface, or the objects shown without a tree.
    [[nodiscard]] bool all_shown() const {
        return document_.tree() ? surface_ready() && !work(WorkKind::kCenterlines).worker().busy()
                                : document_.has_scene() && !awaited(WorkKind::kContext);
    }
    // The shown surface and the surfaces it is compared with, as far as available; outdated ones stay until replaced.
    [[nodiscard]] ShownSurfaces surfaces() const;
    // Background work by kind: whether some is running or about to start; why it failed (empty: it did not); retrying
    // it; and its progress, 0 to 1.
    [[nodiscard]] bool awaited(WorkKind kind) const { return work(kind).awaited(view(), assets_); }
    [[nodiscard]] std::string problem(WorkKind kind) const { return work(kind).problem(); }
    void retry(WorkKind kind);
    [[nodiscard]] float progress(WorkKind kind) const { return work(kind).worker().progress(); }
    // Switches optional work on or off. Validation of the surface (app/assets/validation.h): while its panel is open.
    // Contacts: while they are listed or marked. Cones for the caster: needed where OpenGL is software.
    void want_validation(bool wanted) { validation_wanted_ = wanted; }
    void want_contacts(bool wanted) { contacts_wanted_ = wanted; }
    void want_cones(bool wanted) { cones_wanted_ = wanted; }
    // Waits briefly for the preview of the shown surface if it is due. For callers that draw so slowly that drawing the
    // full surface would take longer.
    void await_preview();
    // Trial options, for example while a slider is held: the surface follows them instead of the session's. None: no
    // trial.
    void try_options(const std::optional<mesh::SurfaceOptions>& options) { tried_ = options; }
    [[nodiscard]] const std::optional<mesh::SurfaceOptions>& tried_options() const { return tried_; }
    // Whether a surface that replaces the shown one is being made or about to be.
    [[nodiscard]] bool surface_awaited() const { return document_.tree() && surface_.awaited(request()); }
    // Why the surface could not be made or was cancelled; cones or an older surface are shown. Empty otherwise.
    [[nodiscard]] const std::string& surface_problem() const { return surface_.problem(); }
    void retry_surface();

    [[nodiscard]] bool busy() const;
    [[nodiscard]] std::string activity() const; // "Reading liver.swc", "Computing the surface"; empty when idle
    [[nodiscard]] float progress() const;       // of the activity, 0 to 1

    // Set if a tree was opened since the last call; the window then fits its camera.
    struct Opened {
        std::filesystem::path path; // as requested; for sessions the session file
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
    // Workers of the tree and its surface.
    [[nodiscard]] std::array<const Worker*, 3> surface_workers() const {
        return {&loader_.worker(), &surface_.worker(), &surface_.cones_worker()};
    }
    [[nodiscard]] const BackgroundWork* busy_work() const; // the first that the status bar names; null: none

    Document document_;
    Assets assets_;
    io::ReadOptions said_reading_;
    std::filesystem::path said_of_;                      // absolute; empty: of all files
    std::shared_ptr<const tree::VesselTree> tree_shown_; // the tree of the surfaces
    std::filesystem::path asked_for_;
    std::optional<mesh::SurfaceOptions> tried_;
    std::optional<Opened> opened_;
    std::deque<Error> errors_;
    Marks marks_before_loading_;
    std::optional<TreeLoader::Arrival> arrival_; // waits to be accepted
    bool contacts_wanted_ = false, validation_wanted_ = false, cones_wanted_ = false;
    bool changed_ = false;
    bool first_is_coming_ = false; // the loader is making the first surface
    // Last: their threads end first.
    TreeLoader loader_;
    SurfaceFollower surface_;
    std::vector<ComparedSurface> compared_; // as far as available
    std::vector<std::unique_ptr<BackgroundWork>> works_;
};

} // namespace ramus::app
