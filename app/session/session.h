// Session: the state of work on a tree as one plain value: file, selection, state of every branch, camera, options of
// the surface. It is small, comparable and serialisable (app/session/session_file.h); undo stores differences between
// sessions (app/session/document.h). It contains no mesh and no window.
//
// Lists are canonical (ascending, without repeats; states without trailing normal ones), so that equal sessions compare
// equal. The functions below maintain that.
#pragma once

#include "app/session/colour_by.h"
#include "app/session/comparison.h"
#include "app/session/depth_cues.h"
#include "app/session/deviation.h"
#include "app/session/objects.h"
#include "app/session/organ.h"
#include "app/session/plans.h"
#include "app/session/saved_views.h"
#include "app/session/slices.h"
#include "core/io/trees/imported_tree.h"
#include "core/mesh/surface_options.h"
#include "core/tree/edit_tree.h"
#include "render/scene/camera.h"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct TreeFile {
    std::filesystem::path path; // absolute
    std::string checksum;       // of the file's bytes (app/session/session_file.h); empty: unknown
    bool operator==(const TreeFile&) const = default;
};

// Distances and diameters that matter for planning an operation.
struct Planning {
    std::vector<double> bands_mm{5.0, 10.0, 20.0}; // margins around lesions, ascending, positive
    double reconstruct_mm = 5.0;                   // cuts through vessels of a larger diameter are marked
    double touch_mm = 0.5;                         // vessels this close to a lesion touch it
    bool operator==(const Planning&) const = default;
};

// How defocused branches look.
struct GlassLook {
    double opacity = 1.0; // 0: only their centerlines; 1: the default; 2: nearly opaque
    double grey = 0.7;    // 0 black to 1 white
    bool operator==(const GlassLook&) const = default;
};

// Everything that undo and redo cover. Each member has a row in app/session/marks_table.h.
struct Marks : SceneObjects {                 // cuts and resections are those of the current plan
    std::vector<tree::Edit> edits;            // of the file's tree, in order; branch ids below refer to the edited tree
    std::vector<int> selection;               // branch ids, ascending
    std::vector<tree::BranchState> states;    // by branch id; branches without an entry are normal
    std::vector<std::pair<int, double>> cuts; // branch, and fraction of its length from the parent's end
    std::map<int, std::string> names;
    std::vector<int> subtree_names;    // ids of `names` that also label all dependents, ascending
    std::vector<tree::System> systems; // all, with changed names or colours; empty: as in the tree (systems.h)
    ColourBy colour_by;
    ColourMap colour_map = ColourMap::kViridis;
    ColourLook colour_look;
    Planning planning;
    GlassLook glass;
    DepthCues depth_cues;
    Comparison comparison;
    DeviationChoice deviation;
    OrganChoice organ;
    Plans plans;
    std::vector<SavedView> views;    // in the order of their lists
    bool skeleton = false;           // centerlines and rings of the radius are drawn over the vessels
    bool contact_marks = false;      // rings where vessels press on each other
    bool shortest_distances = false; // lines from lesions to the nearest vessel of each system
    mesh::SurfaceOptions options;
    io::ReadOptions reading; // of the tree's file
    bool operator==(const Marks&) const = default;
};

// Looks are the marks that say how a tree is viewed (MarksRow::is_look in app/session/marks_table.h).
// `marks` with the looks of `looks`.
[[nodiscard]] Marks with_looks(Marks marks, const Marks& looks);
// Whether two marks differ only in looks, or not at all.
[[nodiscard]] bool differ_in_looks_alone(const Marks& a, const Marks& b);
// `after` with the looks of `now` that did not change between `before` and `after`. `same_branches`: both have the same
// tree, so that a selection of one is a selection of the other.
[[nodiscard]] Marks carry_looks(const Marks& before, const Marks& now, Marks after, bool same_branches);

struct Session {
    TreeFile tree;
    Marks marks;
    render::Camera camera;
    SliceViews slices;
    bool operator==(const Session&) const = default;
};

// Whether there are objects that can be shown without a tree.
[[nodiscard]] inline bool has_objects_alone(const Marks& marks) {
    return !marks.context.empty() || !marks.scans.empty();
}

// The file that the session is about: the tree's, otherwise the first object's; empty: none.
[[nodiscard]] std::filesystem::path subject_of(const Session& session);

// Assigns an id to each object of the scene without one.
void number_objects(Marks& marks);
[[nodiscard]] std::vector<std::array<double, 4>> spheres_of(const Marks& marks);
// The lesions with meshes, without looks, names and ids.
[[nodiscard]] std::vector<Lesion> lesion_meshes(const Marks& marks);
[[nodiscard]] std::vector<std::string> lesion_files(const Marks& marks);           // one for each of these
[[nodiscard]] std::optional<std::size_t> lesion_index(const Marks& marks, int id); // none: no such lesion
// Inserts a lesion after the existing ones of the same shape (spheres, then meshes).
void add_lesion(Marks& marks, Lesion lesion);
// Removes an object from its list in `marks`; with a lesion also the measurements and resections that refer to it.
// Returns how many other objects of the picture were removed.
std::size_t remove_object(Marks& marks, std::vector<Lesion>& list, std::size_t index);
template <SceneObject T> std::size_t remove_object(Marks& /*marks*/, std::vector<T>& list, std::size_t index) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
    return 0;
}
// Changes centre and radius of a sphere. Ends of measurements on it move along.
void change_lesion(Marks& marks, std::size_t index, const std::array<double, 4>& sphere);

// The states that a session lists; every other branch is normal.
inline constexpr std::array kListedStates{tree::BranchState::kHighlighted, tree::BranchState::kDefocused,
                                          tree::BranchState::kHidden};
[[nodiscard]] std::string_view name_of(tree::BranchState state); // "normal", "highlighted", "defocused", "hidden"
[[nodiscard]] tree::BranchState state_of(const Marks& marks, int branch);
void set_state(Marks& marks, std::span<const int> branches, tree::BranchState state);
[[nodiscard]] std::vector<int> branches_in_state(const Marks& marks, tree::BranchState state);

// Sorts ids and removes repeats.
[[nodiscard]] std::vector<int> canonical(std::vector<int> branches);
[[nodiscard]] bool is_selected(const Marks& marks, int branch);

} // namespace ramus::app
