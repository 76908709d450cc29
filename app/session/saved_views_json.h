// The entry of saved views in a session file.
#pragma once

#include "app/session/marks_table.h"

namespace ramus::app::session_json {

// A list of {"name": ..., "camera": {...}}; left out if it is empty.
[[nodiscard]] MarksEntry saved_views_entry();

} // namespace ramus::app::session_json
