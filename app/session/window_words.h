// Rewords advice of the command line for the window, so that people in the window need no terminal.
#pragma once

#include "core/base/error.h"

#include <string>

namespace ramus::app {

// "lower --detail, or prune with --prune" becomes "lower the detail, or prune". Names of `ramus` commands become their
// place in the window, or are omitted.
[[nodiscard]] std::string window_words(std::string text);

// With an upper-case first letter: messages are written to stand in the middle of a line.
[[nodiscard]] std::string capitalised(std::string text);

// The same as window_words() for all texts of an Error.
[[nodiscard]] Error in_window_words(Error error);

} // namespace ramus::app
