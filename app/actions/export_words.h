// Parses the command `export`, and runs exports by kind.
#pragma once

#include "app/actions/action.h"
#include "app/actions/export_kinds.h"
#include "app/reports/report_tables.h"
#include "core/io/meshes/mesh_names.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::app::actions {

inline constexpr const char* kExportUsage =
    "export surface|tree|table|picture|sheet|turntable|report|page|territories FILE; of a surface, tree or table [--of "
    "visible|selected|all]; of a surface [--parts branch|system|none] [--for-printing]; of a table [--rows "
    "branches|cuts|bands|selection|measurements|systems|contacts|validation]; of pictures --size, --background and "
    "more; of a report [--case TEXT]; of a page [--title TEXT] [--size-limit MB] [--without PART]...";

struct Export {
    ExportWhat what{};
    ExportOf of = ExportOf::kVisible;
    std::filesystem::path file;
    std::optional<io::PartsBy> parts; // none: the default
    bool for_printing = false;
    std::string table;             // the name of a TableKind; empty: branches
    std::string case_line;         // for reports
    std::vector<std::string> page; // for pages: the options of the command `page`
    FigureOptions figure;          // for pictures
    std::optional<glm::ivec2> size;
    [[nodiscard]] const ExportKind& kind() const { return export_kinds()[static_cast<std::size_t>(what)]; }
};

[[nodiscard]] Result<Export> export_in(ActionContext& context, Arguments arguments);

[[nodiscard]] std::string saved_text(const char* what, const Export& wanted); // "Surface saved: /data/liver.stl"
[[nodiscard]] Result<void> expect_extension(const Export& wanted, std::string_view extension, const char* what);
// The continuation of an export: changes nothing, reports `sentence`, and lets the window offer the folder.
[[nodiscard]] Continuation has_written(std::filesystem::path file, std::string sentence);
// Work of another process that writes a file (PictureHost::detached_work()). `verb`: of what the window says meanwhile.
[[nodiscard]] Pending done_in_process(const char* verb, std::function<Result<void>(Job&)> work,
                                      const std::filesystem::path& file, std::string sentence);
// Work that writes a table of the document's current state as CSV; takes longer than a frame for large trees.
using TableOf = std::function<Table(const Document&, const Assets&)>;
[[nodiscard]] Pending writing_table(const ActionContext& context, std::filesystem::path file, TableOf table,
                                    std::string sentence);

// Runs an export of this kind; `wanted` must be valid.
[[nodiscard]] Result<Outcome> export_table(ActionContext& context, const Export& wanted);
[[nodiscard]] Result<Outcome> export_report(ActionContext& context, const Export& wanted);
[[nodiscard]] Result<Outcome> export_page(ActionContext& context, const Export& wanted);
[[nodiscard]] Result<Outcome> export_figure(ActionContext& context, const Export& wanted);

} // namespace ramus::app::actions
