// Tables of the organ in reports: figures of the plans, vessels that resections cut, territories.
#pragma once

#include "app/reports/report_tables.h"

namespace ramus::app {

struct Operation; // app/assets/operation.h

// One row per figure of each plan whose operation is made.
[[nodiscard]] Table organ_table(const Document& document, const Assets& assets);
// One row per figure, one column per plan, with units: for people.
[[nodiscard]] Table plans_table(const Document& document, const Assets& assets);
// One row per vessel that a plan with resections cuts, the thickest first. Without an operation: of the current plan.
[[nodiscard]] Table cut_vessels_table(const Document& document, const Operation& operation);
[[nodiscard]] Table cut_vessels_table(const Document& document, const Assets& assets);
// One row per territory that is shown.
[[nodiscard]] Table territories_table(const Document& document, const Assets& assets);

} // namespace ramus::app
