// Entries of lesions in a session file: spheres and meshes are under keys of their own.
#pragma once

#include "app/session/marks_table.h"

namespace ramus::app::session_json {

[[nodiscard]] MarksEntry spheres_entry();       // each is [x, y, z, radius], or an object with further keys
[[nodiscard]] MarksEntry lesion_meshes_entry(); // each is a path, or an object with further keys

} // namespace ramus::app::session_json
