// Session: what a person has made of a tree, as one plain value: which file, what is selected, the state of every
// branch, the camera and the options of the surface. It is small, comparable and serialisable (app/session_file.h);
// undo is a stack of such values (app/document.h). It holds no mesh and no window.
//
// The lists are kept canonical (ascending, without repeats; states without trailing normal ones), so that equal
// sessions compare equal however they came about. The functions below keep them so.
#pragma once

#include "core/mesh/surface.h"
#include "render/frame.h"

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct TreeFile {
    std::filesystem::path path; // absolute
    std::string checksum;       // of the file's bytes (app/session_file.h); empty when not known
    bool operator==(const TreeFile&) const = default;
};

// What a branch's colour says.
enum class ColourBy { kNothing, kGeneration, kStrahler, kDiameter, kBranch };
inline constexpr std::array kColourings{ColourBy::kNothing, ColourBy::kGeneration, ColourBy::kStrahler,
                                        ColourBy::kDiameter, ColourBy::kBranch};
[[nodiscard]] std::string_view name_of(ColourBy quantity); // "nothing", "generation", ...

// Everything that undo and redo cover.
struct Marks {
    std::vector<int> selection;              // branch ids, ascending
    std::vector<render::BranchState> states; // by branch id; branches beyond its end are normal
    std::vector<std::array<double, 4>> lesions;
    std::vector<std::pair<int, double>> cuts;
    std::map<int, std::string> names;
    ColourBy colour_by = ColourBy::kNothing;
    mesh::SurfaceOptions options;
    bool operator==(const Marks&) const = default;
};

struct Session {
    TreeFile tree;
    Marks marks;
    render::Camera camera;
    bool operator==(const Session&) const = default;
};

[[nodiscard]] render::BranchState state_of(const Marks& marks, int branch);
void set_state(Marks& marks, std::span<const int> branches, render::BranchState state);
[[nodiscard]] std::vector<int> branches_in_state(const Marks& marks, render::BranchState state);

// Any ids as a selection: ascending, without repeats.
[[nodiscard]] std::vector<int> canonical(std::vector<int> branches);
[[nodiscard]] bool is_selected(const Marks& marks, int branch);

} // namespace ramus::app
