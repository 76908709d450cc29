// The welcome panel, on a start without a file: what ramus is, and three things to try. Once closed, it does not appear
// again.
#include "app/panels/welcome_panel.h"

#include "app/panels/left_panel.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/storage/opening_files.h"

#include <imgui.h>
#include <utility>

namespace ramus::app {

namespace {

void draw_step(const char* keys, const char* text) {
    const float scale = theme::scale();
    ImGui::TextColored(theme::kAccent, "%s", keys);
    ImGui::SameLine(68.0F * scale);
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

} // namespace

void draw_welcome(InterfaceContext& context) {
    Welcome& welcome = context.interface.of<Welcome>();
    const bool open = context.interface.left_is<Welcome>();
    if (std::exchange(welcome.shown, open) && !open) context.interface.settings.welcome = false;
    if (!open) return;
    const float scale = theme::scale();
    begin_left_panel("welcome", context);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Welcome to ramus");
    ImGui::SameLine();
    widgets::align_right(ImGui::CalcTextSize("Close").x + 14.0F * scale);
    if (widgets::small_button("Close", "Closes this; it does not come again")) context.interface.close_left();
    widgets::rule();
    widgets::quiet_wrapped(
        "ramus shows vessel trees as smooth surfaces, to explore them and to plan with them. This tree is a demo: a "
        "portal vein that ramus has grown, of no patient.");
    ImGui::Dummy({0.0F, 4.0F * scale});
    if (widgets::button("Open my case\xE2\x80\xA6", {ImGui::GetContentRegionAvail().x, 0.0F}, theme::kAccentDim))
        context.perform("open", {});
    widgets::tooltip("A tree, a mask, a scan or a session; or drop the file into the window", "Ctrl+O");
    if (const auto demo = demo_tree(); demo && context.workspace.document().subject() != *demo) {
        if (ImGui::Button("Open the demo", {ImGui::GetContentRegionAvail().x, 0.0F}))
            context.perform("open", {demo->string()});
        widgets::note_item("Open the demo");
    }
    ImGui::Dummy({0.0F, 4.0F * scale});
    widgets::quiet("Three things to try");
    draw_step("click, D", "A vessel, and all that depends on it.");
    draw_step("G", "The selected vessels become grey glass.");
    draw_step("B", "Plan: lesions, margins and cuts.");
    ImGui::Dummy({0.0F, 2.0F * scale});
    widgets::quiet_wrapped("F1 lists all keys, Ctrl+K finds commands. Not a medical device.");
    ImGui::End();
}

} // namespace ramus::app
