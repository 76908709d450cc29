// Spelling of keys in the command table: "Ctrl+Shift+Z", "F12", "?". One spelling for menus, help and matching,
// independent of a window library.
#pragma once

#include <string>

namespace ramus::app {

// A key press: the key's name ("Z", "F12", "Escape", "?") and modifiers. For keys that print other characters than
// letters and digits, the name is the printed character, and Shift is part of it.
struct KeyPress {
    std::string key;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
};

[[nodiscard]] std::string spelling(const KeyPress& press);

} // namespace ramus::app
