// The list of warnings.
#pragma once

#include "app/session/warnings.h"

namespace ramus::app {

// The list of what a person should know.
struct WarningsPanel {
    WarningList list;
};

} // namespace ramus::app
