// Tables of what lies along a vessel: its cross-sections, and a stenosis with what it is compared with. The command
// line, the command `sections` and reports write the same tables.
#pragma once

#include "app/assets/vessel_sections.h"
#include "app/reports/report_tables.h"
#include "core/slice/vessel_path.h"

#include <span>

namespace ramus::app {

// What the surface and, if there is one, a mask show of the vessel, a lumen for each row or section.
struct Outlines {
    Lumens surface, mask; // `mask` may be empty
};

// A row for each sample.
[[nodiscard]] Table sections_table(std::span<const slice::PathSample> samples, const Outlines& sections,
                                   const Lengths& lengths);

// Of the vessel that slices follow; the assets must have its sections.
[[nodiscard]] bool has_sections(const Document& document, const Assets& assets);
[[nodiscard]] Table followed_sections_table(const Document& document, const Assets& assets); // a usual number of rows
// A row for each measure: least and equivalent diameter, area. Without rows if it cannot be measured.
[[nodiscard]] Table stenosis_table(const Document& document, const Assets& assets);
[[nodiscard]] bool has_stenosis(const Document& document, const Assets& assets);

} // namespace ramus::app
