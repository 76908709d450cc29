// Assets: what pictures, panels, reports and commands need beside a session, as one value: what was loaded from files
// that the session names, and what is derived from them, its tree and its marks. compose() and the tables read it;
// nothing in the program keeps such data anywhere else.
//
// The window's workspace owns one, and so does a picture without a window (app/commands/picture_stage.h). An owner uses
// it from one thread and calls refresh() before it reads it. Slow work never happens there:
//  - A worker takes a copy, which is cheap (everything large is shared and immutable), lets complete_lesions() or
//    complete() work on the copy, and hands it back to the owner's thread, where merge() takes over what is new.
//  - So does a command that needs one file: Assets::lesion_mesh() and context_shape() say without touching the disk
//    whether it is there already, load_lesion_mesh() and load_context_shape() read it into the copy, and merge().
// Whoever may wait calls the same functions on the assets themselves.
#pragma once

#include "app/assets/centerlines.h"
#include "app/assets/contacts.h"
#include "app/assets/deviation.h"
#include "app/assets/measured.h"
#include "app/assets/plan.h"
#include "app/assets/selection_outline.h"
#include "app/assets/shapes.h"
#include "app/assets/validation.h"
#include "app/session/branch_facts.h"
#include "app/session/document.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ramus::app {

struct Assets {
    std::shared_ptr<const tree::VesselTree> tree; // that what is derived is about; null: none
    std::shared_ptr<const TreeFacts> facts;

    // Loaded. A file that is not here has not been read, or not yet.
    std::map<std::string, Loaded<LesionMesh>> lesion_meshes; // by file
    std::map<ContextSource, Loaded<ContextShape>> context_shapes;

    // Derived. Each says what it is of; what is missing is null or empty.
    LesionDistances lesion_distances;
    LesionGrid lesion_grid;
    std::shared_ptr<const Plan> plan;
    std::shared_ptr<const Measurements> measurements;
    SurfaceCenterlines centerlines;
    bool centerlines_follow = false; // of large trees: whoever owns the assets makes them, and refresh() leaves them
    std::shared_ptr<const SelectionOutline> outline;
    SurfaceDeviation deviation; // whoever has the surface measures it
    TreeValidation validation;  // of a tree and options that were, perhaps, until others are looked at
    TreeContacts contacts;      // of the tree; of other options of the surface, perhaps, until those are looked for

    // What the measurement with this id says, or why it says nothing. Null: it has not been taken yet.
    [[nodiscard]] const Result<Measured>* measured(int id) const;

    // Null: it was not read, or could not be.
    [[nodiscard]] std::shared_ptr<const LesionMesh> lesion_mesh(const std::string& file) const;
    [[nodiscard]] std::shared_ptr<const ContextShape> context_shape(const ContextSource& source) const;
    // Why it could not be read; none: it was, or nobody has tried.
    [[nodiscard]] std::optional<Error> trouble(const ContextSource& source) const;

    // Who says the unit and the sides of all that is visible of `context`: somebody does where somebody does of each.
    [[nodiscard]] tree::Claims claims_of(const std::vector<ContextItem>& context) const;

    // Around what of `context` is to be seen and has been read.
    [[nodiscard]] render::Box box_of(const std::vector<ContextItem>& context) const;

    void put(const std::string& lesion_file, Loaded<LesionMesh> loaded);
    void put(const ContextSource& source, Loaded<ContextShape> loaded);
};

// Brings what is derived up to the document, but for what takes long: reads no file and measures no distances to
// meshes; until those are there Plan::measuring is true. Nor does it look for contacts. `options`: the surface's, where
// they are not the session's.
void refresh(Assets& assets, const Document& document);
void refresh(Assets& assets, const Document& document, const mesh::SurfaceOptions& options);
// Whether the centerlines are those of other options, or of no tree yet, and somebody makes them new.
[[nodiscard]] bool centerlines_awaited(const Assets& assets, const mesh::SurfaceOptions& options);
void complete_centerlines(Assets& assets, const mesh::SurfaceOptions& options); // makes them, if so
// The plan alone: for commands.
const Plan& refresh_plan(Assets& assets, const Document& document); // the document has a tree

// Whether the distances from meshes on a grid are made as soon as there are margins, or once vessels are coloured by
// them.
enum class GridIs { kMadeAhead, kMadeWhenShown };

// Whether complete_lesions() has something to do: a mesh was not read, or distances to meshes were not measured.
[[nodiscard]] bool lesions_awaited(const Assets& assets, const Marks& marks, GridIs grid);
// Reads lesions (again, where a file was written since) and measures the distances to them. A mesh that cannot be read
// is left out; the plan says why.
void complete_lesions(Assets& assets, const Marks& marks, GridIs grid);
// The same where something is awaited, in this thread, and refreshes the rest.
void complete_lesions(Assets& assets, const Document& document);

// The shape, read in this thread unless it is there and the file was not written since. `axes`: as read_lesion_mesh()
// takes them.
[[nodiscard]] Result<std::shared_ptr<const LesionMesh>> load_lesion_mesh(Assets& assets, const std::string& file,
                                                                         const std::string& axes = {});
[[nodiscard]] Result<std::shared_ptr<const ContextShape>> load_context_shape(Assets& assets,
                                                                             const ContextSource& source, Job& job);

// All visible context, likewise. Fails with the first that cannot be read, and with what == "cancelled" when `job` is.
[[nodiscard]] Result<void> load_context(Assets& assets, const Marks& marks, Job& job);

// Whether complete_contacts() has something to do.
[[nodiscard]] bool contacts_awaited(const Assets& assets, const mesh::SurfaceOptions& options);
// Looks for the contacts of the document's tree under its options, in this thread.
void complete_contacts(Assets& assets, const Document& document);

// All that a picture or a report of the document needs, read, measured and derived in this thread. Fails as
// load_context(). Contacts are looked for where they are marked.
[[nodiscard]] Result<void> complete(Assets& assets, const Document& document, Job& job);

// What `from`, an earlier copy of `assets`, has read and measured since. Distances of another tree stay out.
void merge(Assets& assets, const Assets& from);
// What was loaded for another tree, as far as `marks` name it: `before` is done with.
void keep_loaded(Assets& assets, Assets before, const Marks& marks);

} // namespace ramus::app
