// What can be exported, of what, and in which formats: one row for each kind of file, its formats from the tables of
// core/io. The command `export` and the window's dialog read it.
#pragma once

#include "app/session/document.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

enum class ExportWhat : std::uint8_t { kPicture, kSheet, kTurntable, kReport, kTable, kSurface, kTree };
enum class ExportOf : std::uint8_t { kVisible, kSelected, kAll };

struct ExportFormat {
    std::string label;     // "STL (.stl)"
    std::string extension; // ".stl"
    std::string help;
    bool has_parts = false;    // objects of their own: `--parts` means something
    bool for_printing = false; // programs take its numbers for mm
};

struct ExportKind {
    ExportWhat what;
    std::string_view key; // as the command has it
    const char* label;    // in the dialog
    const char* help;
    bool of_branches;                  // else it is of what the picture shows
    bool of_tree;                      // else it takes no tree
    std::vector<ExportFormat> formats; // one at least
};

inline constexpr std::size_t kExportKinds = 7;
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

// By branch: not 0 where it is exported. The document has a tree.
[[nodiscard]] std::vector<std::uint8_t> exported_branches(const Document& document, ExportOf of);

} // namespace ramus::app
