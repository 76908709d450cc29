#include "app/actions/keys.h"

namespace ramus::app {

std::string spelling(const KeyPress& press) {
    return std::string(press.ctrl ? "Ctrl+" : "") + (press.shift ? "Shift+" : "") + (press.alt ? "Alt+" : "") +
           press.key;
}

} // namespace ramus::app
