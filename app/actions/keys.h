// Keys as the command table names them: "Ctrl+Shift+Z", "F12", "?". One spelling for menus, help and matching, and no
// dependence on a window library.
#pragma once

#include <string>

namespace ramus::app {

// A key press: the name of the key ("Z", "F12", "Escape", "?") and the modifiers held. For keys that print something
// other than letters and digits, the printed character counts, and Shift is part of it.
struct KeyPress {
    std::string key;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
};

[[nodiscard]] std::string spelling(const KeyPress& press);

} // namespace ramus::app
