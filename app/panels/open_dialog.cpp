#include "app/panels/open_dialog.h"

#include "app/assets/shapes.h"
#include "app/panels/figure_preview.h"
#include "app/panels/parts.h"
#include "app/panels/places_list.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <span>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace fs = std::filesystem;

// Copies text into a text field, truncated to its size.
template <std::size_t N> static void put(const std::string& text, std::array<char, N>& field) {
    field.fill('\0');
    std::copy_n(text.begin(), std::min(text.size(), N - 1), field.begin());
}

bool can_be_opened(const fs::path& path) { return io::names_tree(path) || path.extension() == ".json"; } // sessions
bool can_be_mask(const fs::path& path) { return io::names_volume(path); }
bool can_be_table(const fs::path& path) {
    const std::string ending = io::lower_case(path.extension().string());
    return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}
bool can_be_lesion_mesh(const fs::path& path) { return io::names_mesh(path); }

void OpenDialog::show(const fs::path& start, FilePurpose wanted) {
    if (purpose != wanted) shown = 0;
    purpose = wanted;
    open = true;
    filter.fill('\0');
    std::error_code ignored;
    fs::path where = start;
    if (where.empty() || !fs::is_directory(where, ignored)) where = fs::current_path(ignored);
    enter(where);
}

void OpenDialog::show_to_save(const fs::path& suggestion, FilePurpose wanted) {
    show(suggestion.parent_path(), wanted);
    name_focused = false;
    rename(suggestion.filename().string());
    if (wanted == FilePurpose::kExport) rename(exported.suggested(name.data()));
}

void OpenDialog::rename(const std::string& text) {
    put(text, name);
    replace_asked = false;
}

fs::path OpenDialog::named() const {
    if (purpose == FilePurpose::kExport) return folder / exported.named(name.data());
    fs::path target = folder / name.data();
    if (saves_region()) return io::names_volume(target) ? target : fs::path(target.string() + ".nii.gz");
    if (target.extension() == ".json") return target;
    return fs::path(target.string() + (target.extension() == ".ramus" ? ".json" : ".ramus.json"));
}

void OpenDialog::enter(const fs::path& where) {
    std::error_code error;
    folder = fs::absolute(where, error).lexically_normal();
    if (folder.has_parent_path() && folder.filename().empty()) folder = folder.parent_path(); // "a/" is "a"
    marked = -1;
    replace_asked = take_first = false;
    filter.fill('\0');
    put(folder.string(), typed);
    listing.read(folder);
}

namespace {

// A file filter of a dialog.
struct Shown {
    const char* label;
    bool (*fits)(const fs::path&);
    std::string (*extensions)(); // extensions for people
};

// Properties of a dialog's purpose.
struct Purpose {
    FilePurpose purpose;
    const char* title;
    std::vector<Shown> shown;   // the first is the default; "all files" is added
    const char* command;        // receives the file
    bool takes_volumes = false; // also folders that contain a volume
};

bool is_json(const fs::path& path) { return io::lower_case(path.extension().string()) == ".json"; }
std::string json_extension() { return ".ramus.json"; }
std::string tree_and_mask_extensions() {
    return io::readable_tree_extensions() + "; masks: " + io::readable_volume_extensions();
}

const std::array<Purpose, 13>& purposes() {
    const Shown trees{"Trees", io::names_tree, io::readable_tree_extensions};
    const Shown volumes{"Masks and scans", can_be_mask, io::readable_volume_extensions};
    const Shown sessions{"Sessions", is_json, json_extension};
    const Shown meshes{"Meshes", can_be_lesion_mesh, io::readable_mesh_extensions};
    const Shown all_opened{"All that can be opened",
                           [](const fs::path& path) { return can_be_opened(path) || can_be_mask(path); },
                           tree_and_mask_extensions};
    const Shown shapes{"Meshes, masks and scans",
                       [](const fs::path& path) { return can_be_lesion_mesh(path) || can_be_mask(path); },
                       context_extensions};
    const Shown exports{"What was exported", can_be_export, [] { return std::string("such"); }};
    const Shown tables{"Tables", can_be_table, [] { return std::string(".csv, .tsv or .txt"); }};
    static const std::array<Purpose, 13> all{
        {{FilePurpose::kOpen,
          "Open a vessel tree, a mask, a scan or a session",
          {all_opened, trees, volumes, sessions},
          "open",
          true},
         {FilePurpose::kSave, "Save the session", {sessions}, "save"},
         {FilePurpose::kLesionMesh, "Choose the mesh of a lesion", {meshes}, "lesion-mesh"},
         {FilePurpose::kLesionMask, "Choose the mask of the lesions", {volumes}, "lesion-mask", true},
         {FilePurpose::kContext,
          "Choose a mask, a scan or a mesh to show beside the tree",
          {shapes, meshes, volumes},
          "context",
          true},
         {FilePurpose::kData, "Choose a table of further numbers of branches", {tables}, "data"},
         {FilePurpose::kMask, "Choose a mask of the same vessels", {volumes}, "compare-mask", true},
         {FilePurpose::kDeviation,
          "Choose a mesh or mask to measure the deviation from",
          {shapes, meshes, volumes},
          "deviation-from",
          true},
         {FilePurpose::kOrgan, "Choose the mask of the organ", {volumes}, "organ", true},
         {FilePurpose::kScan, "Open a scan or a segmentation", {volumes}, "scan", true},
         {FilePurpose::kRegion, "Save the region as a mask: .nii.gz, .nii or .nrrd", {volumes}, "region-save"},
         {FilePurpose::kRegionTree,
          "Save the region as a mask, and open it as a tree: .nii.gz, .nii or .nrrd",
          {volumes},
          "region-tree"},
         {FilePurpose::kExport, "Export", {exports}, "export"}}};
    return all;
}

const Purpose& purpose_of(const OpenDialog& dialog) {
    return *std::ranges::find(purposes(), dialog.purpose, &Purpose::purpose);
}

// Null: all files.
const Shown* shown_in(const OpenDialog& dialog) {
    const Purpose& purpose = purpose_of(dialog);
    return dialog.shown < purpose.shown.size() ? &purpose.shown[dialog.shown] : nullptr;
}

// Finds the entries to show, ascending.
void find_rows(OpenDialog& dialog) {
    const bool exporting = dialog.purpose == FilePurpose::kExport;
    const std::string filter = io::lower_case(dialog.filter.data());
    const std::string wanted = std::to_string(dialog.listing.version()) + ' ' +
                               std::to_string(static_cast<int>(dialog.purpose)) + ' ' + std::to_string(dialog.shown) +
                               ' ' + std::to_string(static_cast<int>(dialog.exported.what)) + ' ' + filter;
    if (std::exchange(dialog.rows_for, wanted) == wanted) return;
    const Shown* const shown = shown_in(dialog);
    const auto matches = [&](const OpenDialog::Entry& entry) {
        if (entry.lower_case.find(filter) == std::string::npos) return false;
        return entry.folder ||
               ((!exporting || dialog.exported.writes(entry.name)) && (shown == nullptr || shown->fits(entry.name)));
    };
    dialog.rows.clear();
    for (std::size_t n = 0; n < dialog.entries().size(); ++n)
        if (matches(dialog.entries()[n])) dialog.rows.push_back(n);
}

// The row of the marked entry, or the end.
std::vector<std::size_t>::const_iterator row_of_marked(const OpenDialog& dialog) {
    if (dialog.marked < 0) return dialog.rows.end();
    const auto found = std::ranges::lower_bound(dialog.rows, static_cast<std::size_t>(dialog.marked));
    return found != dialog.rows.end() && *found == static_cast<std::size_t>(dialog.marked) ? found : dialog.rows.end();
}

std::string size_text(std::uintmax_t bytes) {
    if (bytes < 1000) return std::to_string(bytes) + " B";
    return bytes < 1'000'000 ? digits(static_cast<double>(bytes) / 1e3) + " kB"
                             : digits(static_cast<double>(bytes) / 1e6) + " MB";
}

// Explains an empty list.
void draw_why_empty(const OpenDialog& dialog) {
    const std::string& problem = dialog.listing.content().problem;
    if (dialog.listing.reading())
        widgets::quiet("Listing this folder...");
    else if (!problem.empty())
        widgets::quiet_wrapped(("This folder cannot be listed: " + problem).c_str());
    else if (dialog.filter[0] != '\0')
        widgets::quiet_wrapped(("No name here has \"" + std::string(dialog.filter.data()) + "\" in it.").c_str());
    else if (dialog.saves())
        widgets::quiet_wrapped("No such files here yet.");
    else if (shown_in(dialog) == nullptr)
        widgets::quiet_wrapped("Nothing here.");
    else
        widgets::quiet_wrapped(
            ("No " + shown_in(dialog)->extensions() + " files here. Choose another folder, or show all files.")
                .c_str());
}

// Returns the path chosen by it.
fs::path draw_entry(OpenDialog& dialog, std::size_t n) {
    fs::path chosen;
    const OpenDialog::Entry& entry = dialog.entries()[n];
    const auto number = static_cast<int>(n);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(number);
    const std::string label = entry.folder ? entry.name + "/" : entry.name;
    if (entry.folder) ImGui::PushStyleColor(ImGuiCol_Text, theme::kQuiet);
    if (ImGui::Selectable(label.c_str(), dialog.marked == number,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        // A click marks, a double click accepts.
        dialog.marked = number;
        if (!entry.folder && dialog.saves()) {
            dialog.rename(entry.name);
            if (dialog.purpose == FilePurpose::kExport) dialog.exported.follow(entry.name);
        } else if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            chosen = dialog.folder / entry.name;
        }
    }
    widgets::note_item(label.c_str());
    if (dialog.to_marked && dialog.marked == number) ImGui::SetScrollHereY();
    if (entry.folder) ImGui::PopStyleColor();
    ImGui::PopID();
    ImGui::TableNextColumn();
    widgets::quiet(entry.changed.c_str());
    ImGui::TableNextColumn();
    if (!entry.folder) widgets::quiet_right(size_text(entry.bytes));
    return chosen;
}

fs::path draw_entries(OpenDialog& dialog, float height) {
    fs::path chosen;
    ImGui::BeginChild("entries", {0.0F, height});
    if (dialog.rows.empty()) draw_why_empty(dialog);
    if (!dialog.rows.empty() &&
        ImGui::BeginTable("files", 3, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("changed", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 76.0F * theme::scale());
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        ImGui::TableNextColumn();
        widgets::column_heading("Name", "The name of the file or the folder");
        ImGui::TableNextColumn();
        widgets::column_heading("Changed", "When it was written last");
        ImGui::TableNextColumn();
        widgets::column_heading("Size", "How large the file is", widgets::HeadingAt::kRight);
        ImGuiListClipper clipper; // there may be thousands
        clipper.Begin(static_cast<int>(dialog.rows.size()));
        if (const auto marked = row_of_marked(dialog); dialog.to_marked && marked != dialog.rows.end()) {
            const auto row = static_cast<int>(marked - dialog.rows.begin());
            clipper.ForceDisplayRangeByIndices(row, row + 1);
        }
        while (clipper.Step())
            for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
                const fs::path its = draw_entry(dialog, dialog.rows[static_cast<std::size_t>(row)]);
                if (!its.empty()) chosen = its;
            }
        ImGui::EndTable();
    }
    dialog.to_marked = false; // entries excluded by the filter have no row
    ImGui::EndChild();
    return chosen;
}

// The name field and the Save button. Returns the file to save to, once confirmed.
fs::path draw_name(OpenDialog& dialog, float button_width, bool& cancelled) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::AlignTextToFramePadding();
    dialog.replace_asked ? ImGui::TextColored(theme::kTrouble, "It exists:") : widgets::quiet("Name");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2.0F * (button_width + gap));
    if (!std::exchange(dialog.name_focused, true)) ImGui::SetKeyboardFocusHere();
    const std::string before = dialog.name.data();
    bool wanted = ImGui::InputText("##name", dialog.name.data(), dialog.name.size(),
                                   ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (before != dialog.name.data()) {
        dialog.replace_asked = false;
        if (dialog.purpose == FilePurpose::kExport) dialog.exported.follow(dialog.name.data());
    }
    ImGui::SameLine();
    cancelled = ImGui::Button("Cancel", {button_width, 0.0F});
    ImGui::SameLine();
    const bool can =
        dialog.name[0] != '\0' && (dialog.purpose != FilePurpose::kExport || dialog.exported.trouble().empty());
    ImGui::BeginDisabled(!can);
    const char* save = dialog.purpose == FilePurpose::kExport ? "Export" : "Save";
    wanted |= widgets::button(dialog.replace_asked ? "Replace" : save, {button_width, 0.0F},
                              dialog.replace_asked ? theme::kTroubleDim : theme::kAccentDim);
    widgets::note_item("Write it");
    ImGui::EndDisabled();
    if (!wanted || !can) return {};
    fs::path target = dialog.named();
    std::error_code ignored;
    if (fs::is_directory(target, ignored)) {
        dialog.enter(target);
        return {};
    }
    const fs::path first = dialog.purpose == FilePurpose::kExport ? dialog.exported.first_file(target) : target;
    if (fs::exists(first, ignored) && !std::exchange(dialog.replace_asked, true)) return {};
    return target;
}

// Up button, path and filter. Returns the path chosen by them.
fs::path draw_path_row(OpenDialog& dialog) {
    fs::path chosen;
    const float filter_width = 150.0F * theme::scale();
    if (ImGui::Button("Up", {44.0F * theme::scale(), 0.0F})) chosen = dialog.folder.parent_path();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - filter_width - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::InputText("##path", dialog.typed.data(), dialog.typed.size(), ImGuiInputTextFlags_EnterReturnsTrue))
        chosen = dialog.typed.data();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(filter_width);
    // Typing without a focused field goes to the filter, including the first letter.
    bool filters = ImGui::IsWindowAppearing() && !dialog.saves();
    if (!dialog.saves() && !ImGui::IsAnyItemActive())
        for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters) {
            const std::size_t length = std::string_view(dialog.filter.data()).size();
            if (letter <= ' ' || letter > '~' || length + 1 >= dialog.filter.size()) continue;
            dialog.filter[length] = static_cast<char>(letter), dialog.filter[length + 1] = '\0';
            filters = true;
        }
    if (filters) ImGui::SetKeyboardFocusHere();
    if (!ImGui::InputTextWithHint("##filter", "Filter", dialog.filter.data(), dialog.filter.size(),
                                  ImGuiInputTextFlags_EnterReturnsTrue))
        return chosen;
    dialog.take_first = true;
    return chosen;
}

// Enter accepts the marked entry, otherwise the first one shown.
fs::path take_first(OpenDialog& dialog) {
    if (dialog.listing.reading() || !std::exchange(dialog.take_first, false) || dialog.rows.empty()) return {};
    const auto marked = row_of_marked(dialog);
    return dialog.folder / dialog.entries()[marked == dialog.rows.end() ? dialog.rows.front() : *marked].name;
}

// Arrow keys move the mark to the next visible entry.
void move_mark(OpenDialog& dialog) {
    const bool down = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow));
    const bool up = !down && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow));
    if ((!down && !up) || dialog.saves()) return;
    const std::size_t marked = dialog.marked < 0 ? dialog.entries().size() : static_cast<std::size_t>(dialog.marked);
    auto to = std::ranges::lower_bound(dialog.rows, marked); // works also for an entry that is not shown
    if (up) {
        if (to == dialog.rows.begin()) return;
        --to;
    } else if (dialog.marked < 0) {
        to = dialog.rows.begin();
    } else if (to != dialog.rows.end() && *to == marked) {
        ++to;
    }
    if (to == dialog.rows.end()) return;
    dialog.marked = static_cast<int>(*to);
    dialog.to_marked = true;
}

// Cancel and Open buttons. Returns the path chosen by them.
fs::path draw_buttons(OpenDialog& dialog, float button_width, bool& cancelled) {
    std::vector<widgets::ListEntry> entries;
    for (const Shown& shown : purpose_of(dialog).shown) entries.push_back({shown.label, shown.extensions()});
    entries.push_back({"All files", ""});
    dialog.shown = widgets::list_row("Show", "Which files are listed", 190.0F, entries,
                                     std::min(dialog.shown, entries.size() - 1));
    ImGui::SameLine();
    widgets::align_right(2.0F * button_width + ImGui::GetStyle().ItemSpacing.x);
    cancelled = ImGui::Button("Cancel", {button_width, 0.0F});
    ImGui::SameLine();
    const bool can_open = dialog.marked >= 0 && dialog.marked < static_cast<int>(dialog.entries().size());
    ImGui::BeginDisabled(!can_open);
    const bool opens = widgets::button("Open", {button_width, 0.0F}, theme::kAccentDim);
    widgets::note_item("Open what is chosen");
    ImGui::EndDisabled();
    return opens ? dialog.folder / dialog.entries()[static_cast<std::size_t>(dialog.marked)].name : fs::path();
}

} // namespace

const char* key_of(FilePurpose purpose) { return std::ranges::find(purposes(), purpose, &Purpose::purpose)->command; }

void draw_open_dialog(InterfaceContext& context) {
    OpenDialog& dialog = context.interface.of<OpenDialog>();
    const bool saving = dialog.saves(), exporting = dialog.purpose == FilePurpose::kExport;
    context.interface.of<FigurePreview>().wanted = false;
    if (!dialog.open || !widgets::begin_dialog("open", exporting ? 900.0F : 820.0F, exporting ? 720.0F : 560.0F))
        return;
    const float scale = theme::scale();
    const Purpose& purpose = purpose_of(dialog);
    fs::path chosen; // the last part that chose one wins
    const auto take = [&](fs::path path) {
        if (!path.empty()) chosen = std::move(path);
    };
    widgets::heading(purpose.title);
    ImGui::Dummy({0.0F, 2.0F * scale});
    if (exporting) draw_export_page(context, dialog);
    std::span<const fs::path> recent;
    if (dialog.purpose == FilePurpose::kOpen) recent = context.interface.recent_files;
    take(draw_places(190.0F * scale, recent));
    ImGui::SameLine(0.0F, 16.0F * scale);
    ImGui::BeginGroup();
    find_rows(dialog);
    move_mark(dialog);
    take(draw_path_row(dialog));
    find_rows(dialog); // the filter may have changed
    take(take_first(dialog));
    ImGui::Dummy({0.0F, 2.0F * scale});
    const float buttons = ImGui::GetFrameHeight() + 2.0F * ImGui::GetStyle().ItemSpacing.y + 2.0F * scale;
    take(draw_entries(dialog, -buttons));
    ImGui::Dummy({0.0F, 2.0F * scale});
    const float button_width = 90.0F * scale;
    bool cancelled = false;
    fs::path target;
    fs::path pressed;
    if (saving)
        target = draw_name(dialog, button_width, cancelled);
    else
        take(pressed = draw_buttons(dialog, button_width, cancelled));
    ImGui::EndGroup();

    std::error_code ignored;
    // A series in a folder is opened as a whole, with Open; a double click looks into the folder.
    const bool series = purpose.takes_volumes && !pressed.empty() && io::is_volume(pressed);
    if (!chosen.empty() && fs::is_directory(chosen, ignored) && !series)
        dialog.enter(chosen);
    else if (!chosen.empty() && !saving)
        target = chosen;
    if (!target.empty() || cancelled) dialog.open = false;
    if (!target.empty()) context.interface.settings.folders[purpose.command] = target.parent_path();
    if (!target.empty())
        context.perform(purpose.command, exporting ? dialog.exported.words(target) : std::vector{target.string()});
    if (!dialog.open) ImGui::CloseCurrentPopup();
    widgets::end_dialog();
}

} // namespace ramus::app
