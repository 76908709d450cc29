// The dialog for errors of files.
#pragma once

#include "core/base/error.h"

#include <deque>

namespace ramus::app {

// Shown one after the other.
struct ErrorDialog {
    std::deque<Error> errors;
    [[nodiscard]] bool open() const { return !errors.empty(); }
    void close() { errors.pop_front(); } // the one that is shown
};

} // namespace ramus::app
