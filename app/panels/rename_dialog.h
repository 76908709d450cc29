// The dialog that names a branch, a system, an object of the scene or a saved view.
#pragma once

#include "core/tree/vessel_tree.h"

#include <array>
#include <optional>
#include <string>

namespace ramus::app {

// The field for the name of a branch, of a system, of an object of the scene, or of a saved view.
struct Rename {
    bool open = false;
    bool fresh = false; // the keyboard is not in it yet
    int branch = tree::kNoBranch;
    int system = -1;                 // instead of a branch; -1: none
    std::string kind, number;        // of an object of the scene, instead; empty: none
    std::optional<std::string> view; // the name of a saved view, instead; empty: of the view as it is
    std::array<char, 128> text{};
    bool subtree = false; // what depends on the branch is called so too
    void show(int id, const std::string& name, bool of_subtree = false);
    void show_system(int index, const std::string& name);
    void show_object(const std::string& object_kind, const std::string& object_number, const std::string& name);
    void show_view(const std::string& now, const std::string& proposed); // `now` empty: saves the view as it is
};

} // namespace ramus::app
