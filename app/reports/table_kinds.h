// The tables that a report has, by name: one row for each.
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
    bool (*there)(const Document&, const Assets&); // what its rows are about
    bool plain_on_page = false;                    // the report's page has the table as it is, without a note
};

[[nodiscard]] std::string table_names(); // "cuts, bands, ..."
// In the order of what is written when no kind is named.
[[nodiscard]] std::span<const TableKind> table_kinds();
[[nodiscard]] const TableKind* table_kind_named(std::string_view name); // null: there is none

} // namespace ramus::app
