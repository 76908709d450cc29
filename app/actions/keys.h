// Keys as the command table names them: "Ctrl+Shift+Z", "F12", "?". One spelling for menus, help and matching, and no
// dependence on a window library.
#pragma once

#include <string>
#include <string_view>

namespace ramus::app {

// A key press: the name of the key ("Z", "F12", "Escape", "?") and the modifiers held. For keys that print something
// other than letters and digits, the printed character counts, and Shift is part of it.
struct KeyPress {
    std::string key;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    bool operator==(const KeyPress&) const = default;
};

// "Ctrl+Shift+Z" as a KeyPress.
[[nodiscard]] KeyPress parse_key(std::string_view text);

[[nodiscard]] std::string spelling(const KeyPress& press); // the other way

} // namespace ramus::app
