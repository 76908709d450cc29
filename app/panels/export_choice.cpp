#include "app/panels/export_choice.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "core/io/file_format.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <imgui.h>
#include <set>
#include <tuple>
#include <utility>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

std::string lower_extension(const fs::path& path) { return io::lower_case(path.extension().string()); }

std::set<std::string> all_extensions() {
    std::set<std::string> extensions;
    for (const ExportKind& kind : export_kinds())
        for (const ExportFormat& format : kind.formats) extensions.insert(format.extension);
    return extensions;
}

constexpr std::array<std::pair<io::PartsBy, const char*>, 3> kParts{{{io::PartsBy::kBranch, "One for each branch"},
                                                                     {io::PartsBy::kSystem, "One for each system"},
                                                                     {io::PartsBy::kNone, "One for all"}}};

const char* key_of(io::PartsBy parts) {
    return parts == io::PartsBy::kBranch ? "branch" : parts == io::PartsBy::kSystem ? "system" : "none";
}

struct Entry {
    std::string label, help;
    bool possible = true;
};

// A label, and beside it a list of which one is chosen; returns its index. `help` explains the list.
std::size_t draw_list(const char* label, const char* help, float width, const std::vector<Entry>& entries,
                      std::size_t chosen) {
    ImGui::AlignTextToFramePadding();
    widgets::quiet(label);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width * theme::scale());
    ImGui::PushID(label);
    const bool open = ImGui::BeginCombo("##list", entries[chosen].label.c_str());
    if (!open) widgets::tooltip(help);
    if (open) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const auto flags = entries[i].possible ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
            if (ImGui::Selectable(entries[i].label.c_str(), i == chosen, flags)) chosen = i;
            widgets::note_item(entries[i].label.c_str());
            if (!entries[i].help.empty()) widgets::tooltip(entries[i].help.c_str());
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
    return chosen;
}

void draw_kinds(ExportChoice& choice) {
    for (const ExportKind& kind : export_kinds()) {
        if (kind.what != ExportWhat::kSurface) ImGui::SameLine(0.0F, 18.0F * theme::scale());
        if (ImGui::RadioButton(kind.label, kind.what == choice.what)) choice.what = kind.what;
        widgets::tooltip(kind.help);
    }
}

void draw_scope(ExportChoice& choice, bool has_selection) {
    std::vector<Entry> entries;
    for (const ExportScope& scope : kExportScopes)
        entries.push_back({scope.label, "", scope.of != ExportOf::kSelected || has_selection});
    choice.of = kExportScopes[draw_list("Of", "Which branches are exported", 160.0F, entries,
                                        static_cast<std::size_t>(choice.of))]
                    .of;
}

// How a surface is written.
void draw_surface_options(ExportChoice& choice, bool has_systems) {
    const float gap = 18.0F * theme::scale();
    if (choice.format().has_parts) {
        ImGui::SameLine(0.0F, gap);
        std::vector<Entry> entries;
        std::size_t chosen = 0;
        const io::PartsBy shown = choice.parts.value_or(has_systems ? io::PartsBy::kSystem : io::PartsBy::kBranch);
        for (std::size_t i = 0; i < kParts.size(); ++i) {
            entries.push_back({kParts[i].second, "", kParts[i].first != io::PartsBy::kSystem || has_systems});
            if (kParts[i].first == shown) chosen = i;
        }
        const auto now = kParts[draw_list("Objects", "What is an object of its own", 170.0F, entries, chosen)].first;
        if (now != shown) choice.parts = now;
    }
    if (choice.format().for_printing) {
        ImGui::SameLine(0.0F, gap);
        ImGui::Checkbox("For printing", &choice.for_printing);
        widgets::tooltip(
            "Makes sure that the surface is closed and in mm, and says how thin it is at its thinnest place");
    }
}

} // namespace

void ExportChoice::follow(const std::string& name) {
    const std::string extension = lower_extension(name);
    const auto take_from = [&](const ExportKind& from) {
        const auto found = std::ranges::find(from.formats, extension, &ExportFormat::extension);
        if (found == from.formats.end()) return false;
        what = from.what;
        formats[static_cast<std::size_t>(what)] = static_cast<std::size_t>(found - from.formats.begin());
        return true;
    };
    // Of two kinds that have the ending the one that is chosen already.
    if (!take_from(kind())) std::ignore = std::ranges::find_if(export_kinds(), take_from);
}

std::string ExportChoice::named(const std::string& name) const {
    const std::string extension = lower_extension(name);
    if (name.empty() || extension == format().extension) return name;
    const std::string stem =
        all_extensions().contains(extension) ? name.substr(0, name.size() - extension.size()) : name;
    return stem + format().extension;
}

std::vector<std::string> ExportChoice::words(const fs::path& file) const {
    std::vector<std::string> words{std::string(kind().key), file.string()};
    if (kind().of_branches)
        words.insert(words.end(), {"--of", std::string(kExportScopes[static_cast<std::size_t>(of)].key)});
    if (what != ExportWhat::kSurface) return words;
    if (format().has_parts && parts) words.insert(words.end(), {"--parts", key_of(*parts)});
    if (format().for_printing && for_printing) words.emplace_back("--for-printing");
    return words;
}

bool can_be_export(const fs::path& path) { return all_extensions().contains(lower_extension(path)); }

std::string export_extensions() {
    const std::set<std::string> extensions = all_extensions();
    return io::listed({extensions.begin(), extensions.end()});
}

bool draw_export_choice(ExportChoice& choice, bool has_selection, bool has_systems) {
    if (!has_selection && choice.of == ExportOf::kSelected) choice.of = ExportOf::kVisible;
    if (!has_systems && choice.parts == io::PartsBy::kSystem) choice.parts.reset();
    const ExportChoice before = choice;
    draw_kinds(choice);
    ImGui::Dummy({0.0F, 1.0F});
    std::size_t& format = choice.formats[static_cast<std::size_t>(choice.what)];
    if (choice.kind().of_branches) {
        draw_scope(choice, has_selection);
        ImGui::SameLine(0.0F, 18.0F * theme::scale());
    }
    std::vector<Entry> entries;
    for (const ExportFormat& each : choice.kind().formats) entries.push_back({each.label, each.help});
    format = draw_list("Format", "How the file is written", 190.0F, entries, format);
    if (choice.what == ExportWhat::kSurface) draw_surface_options(choice, has_systems);
    return before.what != choice.what || before.formats != choice.formats;
}

} // namespace ramus::app
