// ExportChoice: what the export dialog has chosen beside folder and name; its part of the dialog, a page for each kind.
#pragma once

#include "app/actions/export_kinds.h"
#include "app/panels/figure_choice.h"
#include "core/io/meshes/mesh_names.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct ExportChoice {
    ExportWhat what = ExportWhat::kSurface;
    ExportOf of = ExportOf::kVisible;
    std::array<std::size_t, kExportKinds> formats{}; // by kind: an index into its formats
    std::optional<io::PartsBy> parts;                // none: what is usual for the tree
    bool for_printing = false;
    std::string table;                 // the name of a TableKind; empty: branches
    std::array<char, 256> case_line{}; // of a report; typed anew for each
    FigureChoice figure;

    [[nodiscard]] bool draws() const { // a picture of some kind, which has a preview
        return what == ExportWhat::kPicture || what == ExportWhat::kSheet || what == ExportWhat::kTurntable;
    }
    // Of a picture, for this file.
    [[nodiscard]] FigureRequest request(const std::filesystem::path& file) const;
    // The first file that is written.
    [[nodiscard]] std::filesystem::path first_file(const std::filesystem::path& file) const;
    // Why it cannot be written as it is chosen; empty: it can.
    [[nodiscard]] std::string trouble() const;
    [[nodiscard]] const ExportKind& kind() const { return export_kinds()[static_cast<std::size_t>(what)]; }
    [[nodiscard]] const ExportFormat& format() const { return kind().formats[formats[static_cast<std::size_t>(what)]]; }
    // Whether a file of this name could be of the kind.
    [[nodiscard]] bool writes(const std::filesystem::path& file) const;
    // A name that ends as another format does chooses that one, and its kind.
    void follow(const std::string& name);
    // The name with the ending of the format, in place of one that belongs to another.
    [[nodiscard]] std::string named(const std::string& name) const;
    // Of the command, for this file.
    [[nodiscard]] std::vector<std::string> words(const std::filesystem::path& file) const;
};

// By the ending of its name: something that could have been exported.
[[nodiscard]] bool can_be_export(const std::filesystem::path& path);

// What a document has that can be exported.
struct Exportable {
    bool tree = true, selection = false, systems = false;
    std::vector<std::string_view> tables; // names of those that have rows
};

// What, of what there is. True when it is another than before.
bool draw_export_kinds(ExportChoice& choice, bool has_tree);
// Of what, and how. True when what the name ends with is another.
bool draw_export_choice(ExportChoice& choice, const Exportable& has);

} // namespace ramus::app
