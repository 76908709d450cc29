// The table of exports: kinds of files, scopes and formats, which come from the tables of core/io. Read by the command
// `export` and the window's dialog.
#pragma once

#include "app/session/document.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

enum class ExportWhat : std::uint8_t {
    kPicture,
    kSheet,
    kTurntable,
    kReport,
    kPage,
    kTable,
    kSurface,
    kTree,
    kTerritories
};
enum class ExportOf : std::uint8_t { kVisible, kSelected, kAll };

struct ExportFormat {
    std::string label;     // "STL (.stl)"
    std::string extension; // ".stl"
    std::string help;
    bool has_parts = false;    // can store separate objects: `--parts` applies
    bool for_printing = false; // programs interpret its numbers as mm
};

struct ExportKind {
    ExportWhat what;
    std::string_view key; // in the command
    const char* label;    // in the dialog
    const char* help;
    bool of_branches;                  // exports branches; false: the picture
    bool of_tree;                      // needs a tree
    std::vector<ExportFormat> formats; // at least one
};

inline constexpr std::size_t kExportKinds = 9;
[[nodiscard]] const std::array<ExportKind, kExportKinds>& export_kinds(); // in the order of ExportWhat
[[nodiscard]] std::optional<ExportWhat> export_kind_named(std::string_view key);

struct ExportScope {
    ExportOf of;
    std::string_view key; // "visible"
    const char* label;    // "What is visible"
};
inline constexpr std::array<ExportScope, 3> kExportScopes{{{ExportOf::kVisible, "visible", "What is visible"},
                                                           {ExportOf::kSelected, "selected", "What is selected"},
                                                           {ExportOf::kAll, "all", "All"}}};

// By branch: not 0 if it is exported. The document must have a tree.
[[nodiscard]] std::vector<std::uint8_t> exported_branches(const Document& document, ExportOf of);

} // namespace ramus::app
