// Entries of "options" in a session file: settings of the surface and of the picture.
#pragma once

#include "app/session/marks_table.h"

#include <vector>

namespace ramus::app::session_json {

[[nodiscard]] std::vector<MarksEntry> surface_entries(); // Marks::options
[[nodiscard]] std::vector<MarksEntry> colour_look_entries();
[[nodiscard]] std::vector<MarksEntry> planning_entries();
[[nodiscard]] std::vector<MarksEntry> glass_entries();
[[nodiscard]] MarksEntry colour_by_entry();
[[nodiscard]] MarksEntry colour_map_entry();
[[nodiscard]] MarksEntry depth_cues_entry();
[[nodiscard]] MarksEntry flag_entry(const char* key, bool Marks::*member); // written if true

} // namespace ramus::app::session_json
