// The JSON text that commands print with --json. Older names of lengths contain a unit ("length_mm"), and stay for the
// sake of scripts. Each such member is followed by the same value under the name without the unit ("length"), as in
// tables. The member `unit` states the unit: "mm", or "unknown" if neither the file nor the user says it.
#pragma once

#include "core/tree/vessel_tree.h"

#include <nlohmann/json.hpp>
#include <string>

namespace ramus::app {

// Adds the names without a unit to all objects, at any depth, and returns the report as text. Members whose names end
// in _mm, _mm2 or _mm3 get a copy, unless the object already has a member of that name; `units` gets a copy `unit`. A
// report with lengths but without `unit` gets that of `claims`. Members in ml get no copy.
[[nodiscard]] std::string printed_report(nlohmann::ordered_json report, const tree::Claims& claims = {});

} // namespace ramus::app
