// ExportChoice: the choices of the export dialog except folder and name, and the dialog's page for them.
#pragma once

#include "app/actions/export_kinds.h"
#include "app/panels/figure_choice.h"
#include "app/reports/page/case_page.h"
#include "core/io/meshes/mesh_names.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// The fields of the page for browsers.
struct PageFields {
    std::array<char, 256> title{};
    int most_mb = 12;
    std::array<bool, kPageParts.size()> parts = [] { // by kPageParts: whether they are in it
        std::array<bool, kPageParts.size()> all{};
        all.fill(true);
        return all;
    }();
    [[nodiscard]] PageChoice choice() const;
    [[nodiscard]] std::vector<std::string> words() const; // the options of the command `page`
};

struct ExportChoice {
    ExportWhat what = ExportWhat::kSurface;
    ExportOf of = ExportOf::kVisible;
    std::array<std::size_t, kExportKinds> formats{}; // by kind: an index into its formats
    std::optional<io::PartsBy> parts;                // none: the tree's default
    bool for_printing = false;
    std::string table;                 // the name of a TableKind; empty: branches
    std::array<char, 256> case_line{}; // for reports; not remembered
    FigureChoice figure;
    PageFields page; // not remembered, except the limit

    [[nodiscard]] bool draws() const { // a kind of picture, which has a preview
        return what == ExportWhat::kPicture || what == ExportWhat::kSheet || what == ExportWhat::kTurntable;
    }
    // The request for a picture in this file.
    [[nodiscard]] FigureRequest request(const std::filesystem::path& file) const;
    // The first file that will be written.
    [[nodiscard]] std::filesystem::path first_file(const std::filesystem::path& file) const;
    // Why the choice cannot be exported; empty: it can.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] const ExportKind& kind() const { return export_kinds()[static_cast<std::size_t>(what)]; }
    [[nodiscard]] const ExportFormat& format() const { return kind().formats[formats[static_cast<std::size_t>(what)]]; }
    // Whether the name fits a format of the kind.
    [[nodiscard]] bool writes(const std::filesystem::path& file) const;
    // Switches to the format and kind that fit the name's extension.
    void follow(const std::string& name);
    // The name with the format's extension, which replaces one of another format.
    [[nodiscard]] std::string named(const std::string& name) const;
    // The same, as a suggestion: a mask of territories is not to replace the mask of the vessels.
    [[nodiscard]] std::string suggested(const std::string& name) const;
    // The words of the command `export` for this file.
    [[nodiscard]] std::vector<std::string> words(const std::filesystem::path& file) const;
};

// Whether the extension is that of an exportable format.
[[nodiscard]] bool can_be_export(const std::filesystem::path& path);

// What a document can export.
struct Exportable {
    bool tree = true, selection = false, systems = false, territories = false;
    std::vector<std::string_view> tables; // names of tables with rows
    std::string page;                     // what a page would have, and about how large it would be
};

// Draws the choice of the kind. True if it changed.
bool draw_export_kinds(ExportChoice& choice, const Exportable& has);
// Draws scope and options. True if the name's extension changed.
bool draw_export_choice(ExportChoice& choice, const Exportable& has);

} // namespace ramus::app
