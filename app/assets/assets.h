// Assets: the data that pictures, panels, reports and commands need in addition to a session: files that the session
// names, and values derived from them, from its tree and its marks. One value; no other part of the program keeps such
// data.
//
// The window's workspace owns one, and so does a headless picture (app/commands/picture_stage.h). An owner uses it from
// one thread and calls refresh() before reading it. Slow work does not happen there:
// - A worker takes a copy, which is cheap because everything large is shared and immutable, runs complete_lesions() or
//   complete() on the copy and returns it to the owner's thread, where merge() takes over new values.
// - So does a command that needs one file: Assets::lesion_mesh() and context_shape() look it up without disk access;
//   load_lesion() and load_context_shape() read it into the copy. Callers that may block can call these functions
//   on the assets directly.
#pragma once

#include "app/assets/centerlines.h"
#include "app/assets/contacts.h"
#include "app/assets/deviation.h"
#include "app/assets/measured.h"
#include "app/assets/organ.h"
#include "app/assets/plan.h"
#include "app/assets/region.h"
#include "app/assets/scans.h"
#include "app/assets/selection_outline.h"
#include "app/assets/shapes.h"
#include "app/assets/validation.h"
#include "app/assets/vessel_sections.h"
#include "app/session/branch_facts.h"
#include "app/session/document.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ramus::app {

struct Assets {
    std::shared_ptr<const tree::VesselTree> tree; // the tree of derived values; null: none
    std::shared_ptr<const TreeFacts> facts;

    // Loaded files. A missing entry has not been read yet.
    std::map<LesionSource, Loaded<LesionFile>> lesion_files;
    std::map<ContextSource, Loaded<ContextShape>> context_shapes;
    std::map<ScanSource, Loaded<ScanFile>> scans;

    // Derived values. Each has its inputs; missing values are null or empty.
    LesionDistances lesion_distances;
    LesionGrid lesion_grid;
    std::shared_ptr<const Plan> plan;
    std::shared_ptr<const Measurements> measurements;
    SurfaceCenterlines centerlines;
    bool centerlines_follow = false; // large trees: the owner computes centerlines, not refresh()
    std::shared_ptr<const SelectionOutline> outline;
    SurfaceDeviation deviation; // measured by the owner of the surface
    TreeValidation validation;  // may belong to an earlier tree or options
    TreeContacts contacts;      // of the tree; may belong to earlier options of the surface
    OrganAssets organ;
    ScanRegion region; // that a person grows; no part of the session
    FollowedPath followed;                          // of the session's AlongVessel
    std::shared_ptr<const VesselSections> sections; // measured by the owner of the surface; may be of an earlier path

    // The result of the measurement with this id, or why it failed. Null: not measured yet.
    [[nodiscard]] const Result<Measured>* measured(int id) const;

    // Null: not read, or reading failed.
    [[nodiscard]] std::shared_ptr<const LesionMesh> lesion_mesh(const Lesion& lesion) const; // also for spheres
    [[nodiscard]] std::shared_ptr<const ContextShape> context_shape(const ContextSource& source) const;
    // Why reading failed; none: it did not, or was not tried.
    [[nodiscard]] std::optional<Error> trouble(const ContextSource& source) const;
    [[nodiscard]] std::optional<Error> trouble(const Lesion& lesion) const;
    [[nodiscard]] std::shared_ptr<const ScanFile> scan(const Scan& scan) const;
    [[nodiscard]] std::optional<Error> trouble(const Scan& scan) const;

    // The origin of unit and orientation of all visible context and scans; known only if known for each of them.
    [[nodiscard]] tree::Claims claims_of(const SceneObjects& objects) const;

    // Bounding box of the visible items of `context` that have been read.
    [[nodiscard]] render::Box box_of(const std::vector<ContextItem>& context) const;

    void put(const LesionSource& source, Loaded<LesionFile> loaded);
    void put(const ContextSource& source, Loaded<ContextShape> loaded);
    void put(const ScanSource& source, Loaded<ScanFile> loaded);
};

// Updates derived values to the document, except slow ones: it reads no file, measures no distances to meshes
// (Plan::measuring is true until they are available) and searches no contacts. `options`: of the surface, if not the
// session's.
void refresh(Assets& assets, const Document& document);
void refresh(Assets& assets, const Document& document, const mesh::SurfaceOptions& options);
// Whether centerlines are missing or belong to other options, and the owner must compute them.
[[nodiscard]] bool centerlines_awaited(const Assets& assets, const mesh::SurfaceOptions& options);
void complete_centerlines(Assets& assets, const mesh::SurfaceOptions& options); // computes them if awaited
// Refreshes only the plan; for commands.
const Plan& refresh_plan(Assets& assets, const Document& document); // the document has a tree

// When to sample distances to meshes on a grid: as soon as there are margins, or only once vessels are coloured by
// them.
enum class GridIs { kMadeAhead, kMadeWhenShown };

// Whether complete_lesions() has something to do: unread meshes, or unmeasured distances.
[[nodiscard]] bool lesions_awaited(const Assets& assets, const Marks& marks, GridIs grid);
// Reads lesions (again if a file was modified) and measures the distances to them. Unreadable meshes are skipped; the
// plan says why.
void complete_lesions(Assets& assets, const Marks& marks, GridIs grid);
// Does this in the calling thread if necessary, and refreshes the rest.
void complete_lesions(Assets& assets, const Document& document);

// Returns the shape; reads it in the calling thread unless it is loaded and its file unmodified.
[[nodiscard]] Result<std::shared_ptr<const LesionFile>> load_lesion(Assets& assets, const LesionSource& source,
                                                                    Job& job);
[[nodiscard]] Result<std::shared_ptr<const ScanFile>> load_scan(Assets& assets, const ScanSource& source,
                                                                std::uint64_t memory_bytes, Job& job);
[[nodiscard]] Result<std::shared_ptr<const ContextShape>> load_context_shape(Assets& assets,
                                                                             const ContextSource& source, Job& job);

// Reads all visible context, or scans. Fails with the first error; `what` is "cancelled" if `job` is cancelled.
[[nodiscard]] Result<void> load_context(Assets& assets, const Marks& marks, Job& job);
[[nodiscard]] Result<void> load_scans(Assets& assets, const Marks& marks, Job& job);

// Grows the region of the scan that it is of, in the calling thread, unless it is current or the scan is not loaded.
void complete_region(Assets& assets, Job& job);

// Whether complete_contacts() has something to do.
[[nodiscard]] bool contacts_awaited(const Assets& assets, const mesh::SurfaceOptions& options);
// Searches the contacts of the document's tree under its options, in the calling thread.
void complete_contacts(Assets& assets, const Document& document);

// Completes everything that a picture or report of the document needs, in the calling thread. Fails as load_context().
// Searches contacts only if they are marked.
[[nodiscard]] Result<void> complete(Assets& assets, const Document& document, Job& job);

// Takes over what `from`, an earlier copy of `assets`, has read and measured since. Skips distances of another tree.
void merge(Assets& assets, const Assets& from);
// Keeps the files of `before`, the assets of the previous tree, that `marks` name.
void keep_loaded(Assets& assets, Assets before, const Marks& marks);

} // namespace ramus::app
