#include "app/actions/keys.h"

namespace ramus::app {

KeyPress parse_key(std::string_view text) {
    KeyPress press;
    const auto take = [&](std::string_view prefix) {
        if (text.size() <= prefix.size() || !text.starts_with(prefix)) return false;
        text.remove_prefix(prefix.size());
        return true;
    };
    for (bool more = true; more;) {
        more = false;
        if (take("Ctrl+")) press.ctrl = more = true;
        if (take("Shift+")) press.shift = more = true;
        if (take("Alt+")) press.alt = more = true;
    }
    press.key = text;
    return press;
}

std::string spelling(const KeyPress& press) {
    return std::string(press.ctrl ? "Ctrl+" : "") + (press.shift ? "Shift+" : "") + (press.alt ? "Alt+" : "") +
           press.key;
}

} // namespace ramus::app
