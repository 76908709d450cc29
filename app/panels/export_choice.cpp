#include "app/panels/export_choice.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/picture/figures.h"
#include "app/picture/video_file.h"
#include "app/reports/table_kinds.h"
#include "core/io/file_format.h"
#include "core/io/text_numbers.h"
#include "render/renderer/drawn.h"

#include <algorithm>
#include <imgui.h>
#include <set>
#include <tuple>
#include <utility>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

std::set<std::string> all_extensions() {
    std::set<std::string> extensions;
    for (const ExportKind& kind : export_kinds())
        for (const ExportFormat& format : kind.formats) extensions.insert(format.extension);
    return extensions;
}

// The longest that an export has, ".nii.gz"; else what comes after the last full stop.
std::string lower_extension(const fs::path& path) {
    const std::string name = io::lower_case(path.filename().string());
    std::string longest = io::lower_case(path.extension().string());
    for (const std::string& extension : all_extensions())
        if (name.ends_with(extension) && extension.size() > longest.size()) longest = extension;
    return longest;
}

constexpr std::array<std::pair<io::PartsBy, const char*>, 3> kParts{{{io::PartsBy::kBranch, "One for each branch"},
                                                                     {io::PartsBy::kSystem, "One for each system"},
                                                                     {io::PartsBy::kNone, "One for all"}}};

const char* key_of(io::PartsBy parts) {
    return parts == io::PartsBy::kBranch ? "branch" : parts == io::PartsBy::kSystem ? "system" : "none";
}

} // namespace

bool draw_export_kinds(ExportChoice& choice, const Exportable& has) {
    const ExportWhat before = choice.what;
    const auto there = [&](const ExportKind& kind) {
        return (has.tree || !kind.of_tree) && (has.territories || kind.what != ExportWhat::kTerritories);
    };
    if (!there(choice.kind())) choice.what = ExportWhat::kPicture;
    for (const ExportKind& kind : export_kinds()) {
        if (&kind != export_kinds().data()) ImGui::SameLine(0.0F, 10.0F * theme::scale());
        ImGui::BeginDisabled(!there(kind));
        if (ImGui::RadioButton(kind.label, kind.what == choice.what)) choice.what = kind.what;
        ImGui::EndDisabled();
        widgets::tooltip(kind.help);
    }
    return before != choice.what;
}

namespace {

void draw_scope(ExportChoice& choice, bool has_selection) {
    std::vector<widgets::ListEntry> entries;
    for (const ExportScope& scope : kExportScopes)
        entries.push_back({scope.label, "", scope.of != ExportOf::kSelected || has_selection});
    choice.of = kExportScopes[widgets::list_row("Of", "Which branches are exported", 160.0F, entries,
                                                static_cast<std::size_t>(choice.of))]
                    .of;
}

// Options of surface files.
void draw_surface_options(ExportChoice& choice, bool has_systems) {
    const float gap = 18.0F * theme::scale();
    if (choice.format().has_parts) {
        ImGui::SameLine(0.0F, gap);
        std::vector<widgets::ListEntry> entries;
        std::size_t chosen = 0;
        const io::PartsBy shown = choice.parts.value_or(has_systems ? io::PartsBy::kSystem : io::PartsBy::kBranch);
        for (std::size_t i = 0; i < kParts.size(); ++i) {
            entries.push_back({kParts[i].second, "", kParts[i].first != io::PartsBy::kSystem || has_systems});
            if (kParts[i].first == shown) chosen = i;
        }
        const auto now =
            kParts[widgets::list_row("Objects", "What is an object of its own", 170.0F, entries, chosen)].first;
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

PageChoice PageFields::choice() const {
    PageChoice choice;
    choice.title = title.data();
    constexpr std::size_t kMb = 1'000'000;
    choice.most_bytes = static_cast<std::size_t>(most_mb) * kMb;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!parts.at(i)) choice.left_out.push_back(kPageParts.at(i).part);
    return choice;
}

std::vector<std::string> PageFields::words() const {
    std::vector<std::string> words{"--size-limit", std::to_string(most_mb)};
    if (title[0] != '\0') words.insert(words.end(), {"--title", title.data()});
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!parts.at(i)) words.insert(words.end(), {"--without", std::string(kPageParts.at(i).name)});
    return words;
}

void ExportChoice::follow(const std::string& name) {
    const std::string extension = lower_extension(name);
    const auto take_from = [&](const ExportKind& from) {
        const auto found = std::ranges::find(from.formats, extension, &ExportFormat::extension);
        if (found == from.formats.end()) return false;
        what = from.what;
        formats[static_cast<std::size_t>(what)] = static_cast<std::size_t>(found - from.formats.begin());
        return true;
    };
    // Prefers the current kind if several have this extension.
    if (!take_from(kind())) std::ignore = std::ranges::find_if(export_kinds(), take_from);
}

std::string ExportChoice::named(const std::string& name) const {
    const std::string extension = lower_extension(name);
    if (name.empty() || extension == format().extension) return name;
    const std::string stem =
        all_extensions().contains(extension) ? name.substr(0, name.size() - extension.size()) : name;
    return stem + format().extension;
}

std::string ExportChoice::suggested(const std::string& name) const {
    constexpr std::string_view kOfTerritories = "-territories";
    std::string whole = named(name);
    const std::string extension = lower_extension(whole);
    if (whole.empty()) return whole;
    std::string stem = whole.substr(0, whole.size() - extension.size());
    if (stem.ends_with(kOfTerritories)) stem.resize(stem.size() - kOfTerritories.size());
    if (what == ExportWhat::kTerritories) stem += kOfTerritories;
    return stem + whole.substr(whole.size() - extension.size());
}

std::vector<std::string> ExportChoice::words(const fs::path& file) const {
    std::vector<std::string> words{std::string(kind().key), file.string()};
    if (draws()) {
        const auto more = figure_words(request(file));
        words.insert(words.end(), more.begin(), more.end());
    }
    if (what == ExportWhat::kTable && !table.empty())
        words.insert(words.end(), {"--rows", table});
    else if (kind().of_branches)
        words.insert(words.end(), {"--of", std::string(kExportScopes[static_cast<std::size_t>(of)].key)});
    if (what == ExportWhat::kReport && case_line[0] != '\0') words.insert(words.end(), {"--case", case_line.data()});
    if (what == ExportWhat::kPage) {
        const auto more = page.words();
        words.insert(words.end(), more.begin(), more.end());
    }
    if (what != ExportWhat::kSurface) return words;
    if (format().has_parts && parts) words.insert(words.end(), {"--parts", key_of(*parts)});
    if (format().for_printing && for_printing) words.emplace_back("--for-printing");
    return words;
}

bool can_be_export(const fs::path& path) { return all_extensions().contains(lower_extension(path)); }

bool ExportChoice::writes(const fs::path& file) const {
    return std::ranges::find(kind().formats, lower_extension(file), &ExportFormat::extension) != kind().formats.end();
}

FigureRequest ExportChoice::request(const fs::path& file) const {
    FigureRequest request = figure.request(file);
    request.options.sheet = what == ExportWhat::kSheet;
    request.options.turntable = what == ExportWhat::kTurntable ? figure.pictures : 0;
    return request;
}

fs::path ExportChoice::first_file(const fs::path& file) const {
    return what == ExportWhat::kTurntable && !is_video(file) ? numbered(file, 0, figure.pictures) : file;
}

std::string ExportChoice::trouble() const {
    if (!draws()) return {};
    const FigureRequest wanted = request({});
    const glm::ivec2 drawn = wanted.size.value_or(glm::ivec2(1)) * wanted.options.supersample;
    if (const auto fits = render::check_size(drawn.x, drawn.y); !fits) return fits.error().message();
    if (what != ExportWhat::kTurntable || format().extension != ".mp4") return {};
    if (!figure.videos) return kNoVideos;
    return figure.ground == Ground::kTransparent ? "A video has no transparent background" : "";
}

namespace {

void draw_table_choice(ExportChoice& choice, const Exportable& has) {
    std::vector<widgets::ListEntry> entries{{"Branches", "A row for each branch"}};
    std::vector<std::string> names{""};
    std::size_t chosen = 0;
    for (const TableKind& kind : table_kinds()) {
        const bool there = std::ranges::find(has.tables, kind.name) != has.tables.end();
        if (!there && choice.table == kind.name) choice.table.clear();
        if (choice.table == kind.name) chosen = names.size();
        entries.push_back({kind.label, there ? "" : "There is none of it yet", there});
        names.emplace_back(kind.name);
    }
    choice.table = names[widgets::list_row("Rows", "What the table has rows of", 190.0F, entries, chosen)];
}

// The line appears on the page and is stored nowhere else.
void draw_case_line(ExportChoice& choice) {
    ImGui::AlignTextToFramePadding();
    widgets::quiet("Case");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##case", "Which case the report is of, at the head of the page", choice.case_line.data(),
                             choice.case_line.size());
    widgets::note_item("Case line");
    widgets::quiet_wrapped("What you type here is stored in the file as it stands. A patient's name goes wherever the "
                           "file goes. Sessions and settings do not keep it.");
}

void draw_page_fields(PageFields& page, const std::string& contents) {
    ImGui::AlignTextToFramePadding();
    widgets::quiet("Title");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##title", "The name of the file", page.title.data(), page.title.size());
    widgets::note_item("Title of the page");
    ImGui::SetNextItemWidth(160.0F * theme::scale());
    ImGui::SliderInt("##limit", &page.most_mb, 2, 60, "At most %d MB", ImGuiSliderFlags_AlwaysClamp);
    widgets::note_item("Size limit");
    widgets::tooltip("The surface is simplified to be below it, and the page says how much");
    for (std::size_t i = 0; i < kPageParts.size(); ++i) {
        if (i % 4 != 0) ImGui::SameLine(0.0F, 18.0F * theme::scale());
        std::string label(kPageParts.at(i).name);
        label[0] = static_cast<char>(label[0] - 'a' + 'A');
        ImGui::Checkbox(label.c_str(), &page.parts.at(i));
        widgets::tooltip(("In the page: " + std::string(kPageParts.at(i).help)).c_str());
    }
    widgets::quiet_wrapped(contents.c_str());
}

void draw_format(ExportChoice& choice) {
    std::vector<widgets::ListEntry> entries;
    for (const ExportFormat& each : choice.kind().formats)
        entries.push_back({each.label, each.help, each.extension != ".mp4" || choice.figure.videos});
    std::size_t& format = choice.formats[static_cast<std::size_t>(choice.what)];
    format = widgets::list_row("Format", "How the file is written", 190.0F, entries, format);
}

} // namespace

bool draw_export_choice(ExportChoice& choice, const Exportable& has) {
    if (!has.selection && choice.of == ExportOf::kSelected) choice.of = ExportOf::kVisible;
    if (!has.systems && choice.parts == io::PartsBy::kSystem) choice.parts.reset();
    const auto before = choice.formats;
    widgets::quiet_wrapped(choice.kind().help);
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    const float gap = 18.0F * theme::scale();
    if (choice.draws()) {
        draw_figure_choice(choice.figure, choice.what == ExportWhat::kTurntable);
        if (choice.what == ExportWhat::kTurntable) draw_format(choice);
    } else {
        draw_format(choice);
        if (choice.what == ExportWhat::kTable) {
            ImGui::SameLine(0.0F, gap);
            draw_table_choice(choice, has);
        }
        if (choice.kind().of_branches && choice.table.empty()) draw_scope(choice, has.selection);
        if (choice.what == ExportWhat::kSurface) draw_surface_options(choice, has.systems);
        if (choice.what == ExportWhat::kReport) draw_case_line(choice);
        if (choice.what == ExportWhat::kPage) draw_page_fields(choice.page, has.page);
    }
    if (choice.what == ExportWhat::kTurntable && !choice.figure.videos)
        widgets::quiet_wrapped("ffmpeg is not installed, which makes videos of the pictures (apt install ffmpeg).");
    return before != choice.formats;
}

} // namespace ramus::app
