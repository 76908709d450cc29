// Advice that is given in the words of the command line, in those of the window: nobody is sent to a terminal who has a
// window in front of them.
#pragma once

#include "core/base/error.h"

#include <string>

namespace ramus::app {

// "lower --detail, or prune with --prune" becomes "lower the detail, or prune"; what names a command of `ramus` becomes
// where the window does the same, or is left out.
[[nodiscard]] std::string window_words(std::string text);

// The same of all that an Error says.
[[nodiscard]] Error in_window_words(Error error);

} // namespace ramus::app
