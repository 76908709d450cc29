// ExportChoice: what the export dialog has chosen beside folder and name; its part of the dialog.
#pragma once

#include "app/actions/export_kinds.h"
#include "core/io/meshes/mesh_names.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct ExportChoice {
    ExportWhat what = ExportWhat::kSurface;
    ExportOf of = ExportOf::kVisible;
    std::array<std::size_t, 4> formats{}; // by kind: an index into its formats
    std::optional<io::PartsBy> parts;     // none: what is usual for the tree
    bool for_printing = false;

    [[nodiscard]] const ExportKind& kind() const { return export_kinds()[static_cast<std::size_t>(what)]; }
    [[nodiscard]] const ExportFormat& format() const { return kind().formats[formats[static_cast<std::size_t>(what)]]; }
    // A name that ends as another format does chooses that one, and its kind.
    void follow(const std::string& name);
    // The name with the ending of the format, in place of one that belongs to another.
    [[nodiscard]] std::string named(const std::string& name) const;
    // Of the command, for this file.
    [[nodiscard]] std::vector<std::string> words(const std::filesystem::path& file) const;
};

// By the ending of its name: something that could have been exported.
[[nodiscard]] bool can_be_export(const std::filesystem::path& path);
[[nodiscard]] std::string export_extensions(); // ".ply, .stl or .png"

// What, of what, and how. True when something changed.
bool draw_export_choice(ExportChoice& choice, bool has_selection, bool has_systems);

} // namespace ramus::app
