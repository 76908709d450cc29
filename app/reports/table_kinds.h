// The table of report tables, by name.
#pragma once

#include "app/reports/report_tables.h"

#include <span>
#include <string>
#include <string_view>

namespace ramus::app {

struct TableKind {
    std::string_view name;
    const char* label; // for people
    Table (*table)(const Document&, const Assets&);
    bool (*there)(const Document&, const Assets&); // whether it would have rows
    bool plain_on_page = false;                    // shown on the report's page unchanged, without a note
};

[[nodiscard]] std::string table_names(); // "cuts, bands, ..."
// In the order of output if no kind is named.
[[nodiscard]] std::span<const TableKind> table_kinds();
[[nodiscard]] const TableKind* table_kind_named(std::string_view name); // null: unknown
// The error of a table without rows.
[[nodiscard]] Error nothing_to_report(std::string_view name);

} // namespace ramus::app
