#include "app/panels/figure_choice.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

struct SizeRow {
    const char* label;
    glm::ivec2 size;
};
constexpr std::array<SizeRow, 5> kSizes{{{"Slide, 1920 x 1080", {1920, 1080}},
                                         {"Slide, 3840 x 2160", {3840, 2160}},
                                         {"Paper, 1600 x 1200", {1600, 1200}},
                                         {"Paper, 3200 x 2400", {3200, 2400}},
                                         {"Square, 2000 x 2000", {2000, 2000}}}};
constexpr double kPointsHigh = 900.0; // text scales with the picture, as in a window of this height

void draw_number(const char* id, const char* help, int& number, float width) {
    ImGui::SetNextItemWidth(width * theme::scale());
    ImGui::InputInt(id, &number, 0, 0);
    widgets::tooltip(help);
}

void draw_size(FigureChoice& choice) {
    const glm::ivec2 window = choice.window_size;
    std::vector<widgets::ListEntry> entries{
        {"As in the window, " + std::to_string(window.x) + " x " + std::to_string(window.y), ""}};
    std::size_t chosen = kSizes.size() + 1;
    for (const SizeRow& row : kSizes) {
        if (row.size == choice.size) chosen = entries.size();
        entries.push_back({row.label, ""});
    }
    entries.push_back({"Other", ""});
    if (choice.as_window) chosen = 0;
    const std::size_t now = widgets::list_row("Size", "How many pixels the picture has", 210.0F, entries, chosen);
    if (now != chosen) {
        choice.as_window = now == 0;
        if (now >= 1 && now <= kSizes.size()) choice.size = kSizes[now - 1].size;
        if (now > kSizes.size()) choice.size += 1; // differs from all presets
    }
    if (choice.as_window) return;
    ImGui::SameLine();
    draw_number("##width", "Pixels across", choice.size.x, 58.0F);
    ImGui::SameLine(0.0F, 4.0F * theme::scale());
    widgets::quiet("x");
    ImGui::SameLine(0.0F, 4.0F * theme::scale());
    draw_number("##height", "Pixels down", choice.size.y, 58.0F);
}

void draw_ground(FigureChoice& choice) {
    std::vector<widgets::ListEntry> entries;
    for (const GroundRow& row : kGrounds) entries.push_back({row.label, ""});
    choice.ground = kGrounds[widgets::list_row("Background", "What is behind the tree", 120.0F, entries,
                                               static_cast<std::size_t>(choice.ground))]
                        .ground;
}

void draw_edges(FigureChoice& choice) {
    constexpr std::array<int, 3> kFactors{1, 2, 4};
    const std::vector<widgets::ListEntry> entries{{"Smooth", "Sixteen samples a pixel"},
                                                  {"Drawn twice as large", "And reduced: finer lines, more time"},
                                                  {"Drawn four times as large", "And reduced: for small pictures"}};
    const auto chosen = static_cast<std::size_t>(std::ranges::find(kFactors, choice.supersample) - kFactors.begin());
    choice.supersample =
        kFactors[widgets::list_row("Edges", "How smooth edges are", 180.0F, entries, std::min<std::size_t>(chosen, 2))];
}

void draw_turn(FigureChoice& choice) {
    ImGui::AlignTextToFramePadding();
    widgets::quiet("Pictures");
    ImGui::SameLine();
    draw_number("##pictures", "Pictures once around", choice.pictures, 52.0F);
    ImGui::SameLine();
    widgets::quiet("a second");
    ImGui::SameLine();
    draw_number("##rate", "Pictures a second of a video", choice.rate, 44.0F);
    choice.pictures = std::clamp(choice.pictures, 2, kMostTurntable);
    choice.rate = std::clamp(choice.rate, 1, 120);
    ImGui::SameLine(0.0F, 18.0F * theme::scale());
    ImGui::Checkbox("Whole tree", &choice.whole);
    widgets::tooltip("Comes so near that the tree stays whole in all pictures; else as near as the window is now");
}

} // namespace

std::array<bool, kFigureOverlays.size()> FigureChoice::usual_overlays() {
    std::array<bool, kFigureOverlays.size()> usual{};
    std::ranges::transform(kFigureOverlays, usual.begin(), &OverlayRow::usual);
    return usual;
}

FigureRequest FigureChoice::request(const std::filesystem::path& file) const {
    FigureRequest request;
    request.file = file;
    request.size = as_window ? window_size : size;
    FigureOptions& options = request.options;
    options.ground = ground;
    options.caption = caption.data();
    options.supersample = supersample;
    options.frames_a_second = rate;
    options.whole = whole;
    options.text_size = as_window ? double(window_text)
                                  : std::clamp(std::round(10.0 * size.y / kPointsHigh) / 10.0, 1.0, kMostTextSize);
    if (overlays == usual_overlays()) return request;
    options.overlays_given = true;
    for (std::size_t i = 0; i < overlays.size(); ++i)
        if (overlays[i]) options.overlays.emplace_back(kFigureOverlays[i].key);
    return request;
}

void draw_figure_choice(FigureChoice& choice, bool turns) {
    draw_size(choice);
    draw_ground(choice);
    ImGui::SameLine(0.0F, 18.0F * theme::scale());
    draw_edges(choice);
    ImGui::AlignTextToFramePadding();
    widgets::quiet("Caption");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##caption", "Words at the top left", choice.caption.data(), choice.caption.size());
    widgets::note_item("Words at the top left");
    for (std::size_t i = 0; i < choice.overlays.size(); ++i) {
        if (i > 0) ImGui::SameLine(0.0F, 14.0F * theme::scale());
        ImGui::Checkbox(kFigureOverlays[i].label, &choice.overlays[i]);
        widgets::note_item(kFigureOverlays[i].label);
    }
    if (turns) draw_turn(choice);
}

} // namespace ramus::app
