// The bar under the picture that flies the camera along the vessels: play, and a slider from the root to the end.
#include "app/panels/fly_panel.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

constexpr double kLongestStep = 0.5; // seconds: after a longer pause of the program the flight continues where it was

void fly_to(InterfaceContext& context, double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7f", std::clamp(fraction, 0.0, 1.0));
    std::vector<std::string> words{std::to_string(context.interface.of<Fly>().branch), text};
    if (context.interface.of<Fly>().inside) words.emplace_back("inside");
    context.perform("fly", words);
}

void play_on(InterfaceContext& context, const FlyPath& path) {
    Fly& fly = context.interface.of<Fly>();
    const double passed = std::clamp(context.now - fly.last, 0.0, kLongestStep);
    fly.last = context.now;
    if (!fly.playing || context.commands.awaits()) return; // the last step has not taken effect yet
    // Moving the camera by hand stops the flight.
    if (fly.camera != context.workspace.document().session().camera) {
        fly.playing = false;
        return;
    }
    const double next = path.after(fly.fraction, passed);
    if (next > fly.fraction) fly_to(context, next);
    if (next >= 1.0) fly.playing = false;
}

// A triangle or two bars, which the font lacks.
bool play_button(bool playing, float side) {
    const bool pressed = ImGui::Button("##play", {side, side});
    const ImVec2 from = ImGui::GetItemRectMin();
    const float unit = side / 12.0F;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 colour = ImGui::GetColorU32(theme::kText);
    const auto at = [&](float x, float y) { return ImVec2(from.x + x * unit, from.y + y * unit); };
    if (playing) {
        list->AddRectFilled(at(3.6F, 3.2F), at(5.2F, 8.8F), colour);
        list->AddRectFilled(at(6.8F, 3.2F), at(8.4F, 8.8F), colour);
    } else {
        list->AddTriangleFilled(at(4.2F, 2.8F), at(4.2F, 9.2F), at(9.2F, 6.0F), colour);
    }
    return pressed;
}

void toggle_play(InterfaceContext& context) {
    Fly& fly = context.interface.of<Fly>();
    fly.playing = !fly.playing;
    fly.last = context.now;
    if (fly.playing) fly_to(context, fly.fraction >= 1.0 ? 0.0 : fly.fraction);
}

// Between the scale bar and the cube if the picture is wide enough, otherwise above them.
void begin_bar(const Layout& layout) {
    const float scale = theme::scale();
    const auto view_width = static_cast<float>(layout.view_size.x);
    const float corners = 150.0F * scale; // scale bar and cube
    const bool between = view_width >= 2.0F * corners + 360.0F * scale;
    const float width = between ? std::min(620.0F * scale, view_width - 2.0F * corners) : view_width - 20.0F * scale;
    const float height = 72.0F * scale;
    const float bottom = static_cast<float>(layout.view_at.y + layout.view_size.y) - (between ? 16.0F : 104.0F) * scale;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 8.0F * scale});
    ImGui::SetNextWindowPos(
        {std::round(static_cast<float>(layout.view_at.x) + 0.5F * (view_width - width)), bottom - height});
    ImGui::SetNextWindowSize({width, height});
    ImGui::SetNextWindowBgAlpha(0.92F);
    ImGui::Begin("fly along", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
}

// The destination, the position, and a Close button.
void draw_title_row(InterfaceContext& context, const FlyPath& path) {
    Fly& fly = context.interface.of<Fly>();
    const Document& document = context.workspace.document();
    const float scale = theme::scale();
    const std::string label = label_of(document.dependency(), document.marks(), fly.branch);
    const std::string title = "Fly along to branch " + std::to_string(fly.branch) + (label.empty() ? "" : ", " + label);
    const std::string passed =
        document.lengths().text(fly.fraction * path.length_mm()) + " of " + document.lengths().text(path.length_mm());
    const float close_width = ImGui::CalcTextSize("Close").x + 12.0F * scale;
    const float passed_width = ImGui::CalcTextSize(passed.c_str()).x;
    ImGui::TextUnformatted(
        widgets::fitted(title, ImGui::GetContentRegionAvail().x - close_width - passed_width - 36.0F * scale).c_str());
    ImGui::SameLine();
    widgets::align_right(passed_width + 12.0F * scale + close_width);
    widgets::quiet(passed.c_str());
    ImGui::SameLine(0.0F, 12.0F * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {4.0F * scale, 0.0F});
    if (widgets::button("Close", {close_width, 0.0F}, theme::kNothing, theme::kQuiet)) fly.open = fly.playing = false;
    ImGui::PopStyleVar();
    widgets::tooltip("Ends the flight; the view stays", "Escape");
}

void draw_controls(InterfaceContext& context) {
    Fly& fly = context.interface.of<Fly>();
    if (play_button(fly.playing, ImGui::GetFrameHeight())) toggle_play(context);
    widgets::tooltip(fly.playing ? "Pause" : "Fly from here to the end of the branch");
    ImGui::SameLine();
    if (ImGui::Checkbox("Inside", &fly.inside)) fly_to(context, fly.fraction);
    widgets::tooltip("Flies within the vessel, with the centerlines ahead");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    auto fraction = static_cast<float>(fly.fraction);
    if (ImGui::SliderFloat("##fraction", &fraction, 0.0F, 1.0F, "", ImGuiSliderFlags_AlwaysClamp)) {
        fly.playing = false;
        fly_to(context, fraction);
    }
    if (!ImGui::IsItemActive()) widgets::tooltip("From the root to the end of the branch");
}

} // namespace

void draw_fly(InterfaceContext& context) {
    Fly& fly = context.interface.of<Fly>();
    const Document& document = context.workspace.document();
    if (!fly.open) return;
    // Selecting another branch while paused makes it the next destination.
    const auto& selection = document.marks().selection;
    if (!fly.playing && selection != fly.selection) {
        fly.selection = selection;
        if (selection.size() == 1) fly.branch = selection.front();
    }
    if (fly.branch < 0 || fly.branch >= document.branch_count()) {
        fly.open = fly.playing = false;
        return;
    }
    const FlyPath& path = *context.actions.picture.flights.to(document.tree(), fly.branch,
                                                              fly.inside ? Flight::kInside : Flight::kOutside);
    play_on(context, path);
    begin_bar(context.layout);
    draw_title_row(context, path);
    draw_controls(context);
    ImGui::End();
}

} // namespace ramus::app
