// Tables of the organ in reports: figures of the plans, vessels that resections cut, territories.
#pragma once

#include "app/reports/report_tables.h"

namespace ramus::app {

// One row per figure of each plan whose operation is made.
[[nodiscard]] Table organ_table(const Document& document, const Assets& assets);
// One row per figure, one column per plan, with units: for people.
[[nodiscard]] Table plans_table(const Document& document, const Assets& assets);
// One row per vessel that the current plan's resections cut, the thickest first.
[[nodiscard]] Table cut_vessels_table(const Document& document, const Assets& assets);
// One row per territory that is shown.
[[nodiscard]] Table territories_table(const Document& document, const Assets& assets);

} // namespace ramus::app
