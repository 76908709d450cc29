// The dialog for radii.
#pragma once

#include <array>

namespace ramus::app {

// Asks for the radii of the selected branches.
struct RadiusDialog {
    bool open = false;
    bool fresh = false;  // the keyboard is not in it yet
    bool scales = false; // the number is a factor
    std::array<char, 32> text{};
};

} // namespace ramus::app
