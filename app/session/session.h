// Session: what a person has made of a tree, as one plain value: which file, what is selected, the state of every
// branch, the camera and the options of the surface. It is small, comparable and serialisable
// (app/session/session_file.h); undo keeps what lies between such values (app/session/document.h). It holds no mesh and
// no window.
//
// The lists are kept canonical (ascending, without repeats; states without trailing normal ones), so that equal
// sessions compare equal however they came about. The functions below keep them so.
#pragma once

#include "app/session/colour_by.h"
#include "app/session/comparison.h"
#include "app/session/depth_cues.h"
#include "app/session/deviation.h"
#include "app/session/objects.h"
#include "core/io/trees/imported_tree.h"
#include "core/mesh/surface_options.h"
#include "core/tree/edit_tree.h"
#include "render/scene/frame.h"

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
    std::string checksum;       // of the file's bytes (app/session/session_file.h); empty when not known
    bool operator==(const TreeFile&) const = default;
};

// What distances and diameters mean to who plans an operation.
struct Planning {
    std::vector<double> bands_mm{5.0, 10.0, 20.0}; // margins around lesions, ascending, positive
    double reconstruct_mm = 5.0;                   // cuts through vessels of a larger diameter are marked
    double touch_mm = 0.5;                         // what is as near to a lesion touches it
    bool operator==(const Planning&) const = default;
};

// How defocused branches look.
struct GlassLook {
    double opacity = 1.0; // 0: only their centerlines; 1: the usual veil; 2: nearly solid
    double grey = 0.7;    // 0 black to 1 white
    bool operator==(const GlassLook&) const = default;
};

// Everything that undo and redo cover. Each member has a row in app/session/marks_table.h.
struct Marks : SceneObjects {
    std::vector<tree::Edit> edits;           // of the file's tree, in order; ids below are those of the tree after them
    std::vector<int> selection;              // branch ids, ascending
    std::vector<render::BranchState> states; // by branch id; branches beyond its end are normal
    std::vector<std::pair<int, double>> cuts; // branch, and where: of its length from the parent's end
    std::map<int, std::string> names;
    std::vector<int> subtree_names;    // ids of `names`, ascending: these are also what depends on the branch is called
    std::vector<tree::System> systems; // all, renamed or recoloured; empty: as the tree has them (systems.h)
    ColourBy colour_by;
    ColourMap colour_map = ColourMap::kViridis;
    ColourLook colour_look;
    Planning planning;
    GlassLook glass;
    DepthCues depth_cues;
    Comparison comparison;
    DeviationChoice deviation;
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
// Whether two of them differ in nothing else; true of equal ones.
[[nodiscard]] bool differ_in_looks_alone(const Marks& a, const Marks& b);
// `after` with the looks of `now` that did not change between `before` and `after`. `same_branches`: both have the same
// tree, so that a selection of one is a selection of the other.
[[nodiscard]] Marks carry_looks(const Marks& before, const Marks& now, Marks after, bool same_branches);

struct Session {
    TreeFile tree;
    Marks marks;
    render::Camera camera;
    bool operator==(const Session&) const = default;
};

// What it is of: the tree's file, else the first of what is shown without one; empty: of nothing.
[[nodiscard]] std::filesystem::path subject_of(const Session& session);

// Gives an id to each object of the scene that has none.
void number_objects(Marks& marks);
[[nodiscard]] std::vector<std::array<double, 4>> spheres_of(const Marks& marks);
[[nodiscard]] std::vector<std::string> lesion_files(const Marks& marks); // of those that are meshes
// What somebody said about the axes of a lesion's file; empty: nothing.
[[nodiscard]] std::string axes_of_lesion(const Marks& marks, const std::string& file);
[[nodiscard]] std::optional<std::size_t> lesion_index(const Marks& marks, int id); // none: there is no such lesion
// Puts a lesion behind those of its shape.
void add_lesion(Marks& marks, Lesion lesion);
// Takes an object out of its list in `marks`; a lesion with the measurements that name it. Returns how many other
// objects went with it.
std::size_t remove_object(Marks& marks, std::vector<Lesion>& list, std::size_t index);
template <SceneObject T> std::size_t remove_object(Marks& /*marks*/, std::vector<T>& list, std::size_t index) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
    return 0;
}
// Gives a sphere another centre and radius. Ends of measurements on it move with it.
void change_lesion(Marks& marks, std::size_t index, const std::array<double, 4>& sphere);

// All states that a session lists; every other branch is normal.
inline constexpr std::array kListedStates{render::BranchState::kHighlighted, render::BranchState::kDefocused,
                                          render::BranchState::kHidden};
[[nodiscard]] std::string_view name_of(render::BranchState state); // "normal", "highlighted", "defocused", "hidden"
[[nodiscard]] render::BranchState state_of(const Marks& marks, int branch);
void set_state(Marks& marks, std::span<const int> branches, render::BranchState state);
[[nodiscard]] std::vector<int> branches_in_state(const Marks& marks, render::BranchState state);

// Any ids as a selection: ascending, without repeats.
[[nodiscard]] std::vector<int> canonical(std::vector<int> branches);
[[nodiscard]] bool is_selected(const Marks& marks, int branch);

} // namespace ramus::app
