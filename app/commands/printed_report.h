// What commands print with --json. Scripts know members by names with a unit ("length_mm"), which stay. Next to each of
// them stands the same value under the name that tables have, without the unit ("length"), and `unit` says what it is:
// "mm", or "unknown" where nobody has said so. Those names are the same whatever the unit is.
#pragma once

#include "core/tree/vessel_tree.h"

#include <nlohmann/json.hpp>
#include <string>

namespace ramus::app {

// Adds the names without a unit, in all objects and lists: of what ends in _mm, _mm2 or _mm3, unless the object has a
// member of that name, and `unit` next to each `units`. A report with such lengths and without `units` gets the unit of
// `claims`. Not for millilitres, whose numbers are others than those of mm^3.
[[nodiscard]] std::string printed_report(nlohmann::ordered_json report, const tree::Claims& claims = {});

} // namespace ramus::app
