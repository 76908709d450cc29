// The command palette: finds commands by words, shows their keys, runs them by Enter or a click. For a command that
// needs arguments the field asks for them.
#include "app/panels/command_palette.h"

#include "app/actions/command_search.h"
#include "app/actions/script.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <imgui.h>
#include <utility>

namespace ramus::app {

namespace {

bool can_run(const InterfaceContext& context, const Command& command) {
    return command.enabled == nullptr || command.enabled(context.workspace.document());
}

bool pressed_key(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

// Runs the command, or asks for its arguments.
void choose_command(InterfaceContext& context, const Command& command) {
    CommandPalette& palette = context.interface.of<CommandPalette>();
    if (needs_arguments(command)) {
        palette.asks_for = &command;
        palette.typed.fill('\0');
        palette.fresh = true;
        return;
    }
    palette.open = false;
    context.perform(command);
}

void draw_command_row(InterfaceContext& context, const Command& command, bool chosen, bool& pressed) {
    const float scale = theme::scale();
    const bool enabled = can_run(context, command);
    const std::string title = title_of(command, context.workspace.document());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = 2.0F * ImGui::GetTextLineHeight() + 10.0F * scale;
    // Only the row that Enter runs is marked, wherever the pointer rests.
    const ImVec4 mark = chosen ? ImGui::GetStyleColorVec4(ImGuiCol_Header) : ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
    ImGui::PushStyleColor(ImGuiCol_HeaderHovered, mark);
    pressed = ImGui::Selectable("##row", chosen, enabled ? 0 : ImGuiSelectableFlags_Disabled, {0.0F, height});
    ImGui::PopStyleColor();
    widgets::note_item(title.c_str());
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float left = from.x + 8.0F * scale, top = from.y + 3.0F * scale;
    const ImVec4 words = enabled ? theme::kText : theme::kQuiet;
    list->AddText({left, top}, ImGui::GetColorU32(words), title.c_str());
    const std::string key = command.keys.empty() ? "" : command.keys.front();
    const float key_at = from.x + width - ImGui::CalcTextSize(key.c_str()).x - 8.0F * scale;
    list->AddText({key_at, top}, ImGui::GetColorU32(theme::kAccent), key.c_str());
    const std::string help =
        widgets::fitted(enabled ? command.help : command.help + " Not now.", width - 16.0F * scale);
    list->AddText({left, top + ImGui::GetTextLineHeight() + 3.0F * scale}, ImGui::GetColorU32(theme::kQuiet),
                  help.c_str());
}

void draw_found(InterfaceContext& context, bool entered) {
    CommandPalette& palette = context.interface.of<CommandPalette>();
    const std::vector<const Command*> found = search_commands(palette.typed.data());
    const int last = static_cast<int>(found.size()) - 1;
    const int before = palette.chosen;
    palette.chosen += pressed_key(ImGuiKey_DownArrow) ? 1 : pressed_key(ImGuiKey_UpArrow) ? -1 : 0;
    palette.chosen = std::clamp(palette.chosen, 0, std::max(0, last));
    ImGui::BeginChild("found", {0.0F, 0.0F});
    const Command* picked = nullptr;
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    const bool moves = moved.x != 0.0F || moved.y != 0.0F; // rows that scroll under a resting pointer are not chosen
    int pointed_at = palette.chosen;
    for (int n = 0; n <= last; ++n) {
        const Command& command = *found[static_cast<std::size_t>(n)];
        ImGui::PushID(n);
        bool pressed = false;
        draw_command_row(context, command, n == palette.chosen, pressed);
        if (moves && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) pointed_at = n;
        if (n == palette.chosen && palette.chosen != before) ImGui::SetScrollHereY();
        if (pressed || (entered && n == palette.chosen && can_run(context, command))) picked = &command;
        ImGui::PopID();
    }
    palette.chosen = pointed_at;
    if (found.empty()) widgets::quiet("No command has these words.");
    ImGui::EndChild();
    if (picked != nullptr) choose_command(context, *picked);
}

// A command whose arguments are being typed; `line`: its name and arguments as in a commands file.
void draw_arguments(InterfaceContext& context, const Command& command, const std::string& line, bool entered) {
    CommandPalette& palette = context.interface.of<CommandPalette>();
    widgets::quiet_wrapped(command.help.c_str());
    ImGui::Dummy({0.0F, 4.0F * theme::scale()});
    widgets::quiet_wrapped(("It takes: " + command.arguments + ". Enter runs it.").c_str());
    if (!palette.trouble.empty()) widgets::trouble(palette.trouble.c_str());
    if (!entered) return;
    auto words = parse_script(line, "arguments");
    auto done = words ? context.commands.run(context.actions, words->front().words)
                      : Result<void>(tl::unexpected(words.error()));
    if (done)
        palette.open = false;
    else
        palette.trouble = done.error().message();
    palette.fresh = true; // Enter has removed the keyboard focus from the field
}

} // namespace

void CommandPalette::toggle() {
    const bool opens = !open;
    *this = {};
    open = fresh = opens;
}

void draw_command_palette(InterfaceContext& context) {
    CommandPalette& palette = context.interface.of<CommandPalette>();
    if (!palette.open || !widgets::begin_dialog("##palette", 620.0F, 460.0F)) return;
    if (std::exchange(palette.fresh, false)) ImGui::SetKeyboardFocusHere();
    const std::string title =
        palette.asks_for == nullptr ? "What to do" : title_of(*palette.asks_for, context.workspace.document());
    widgets::heading(title.c_str());
    ImGui::SetNextItemWidth(-1.0F);
    const std::array before = palette.typed;
    const bool entered = ImGui::InputTextWithHint(
        "##words", palette.asks_for == nullptr ? "hide, tumour, print, left..." : palette.asks_for->arguments.c_str(),
        palette.typed.data(), palette.typed.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    widgets::note_item("command");
    if (palette.typed != before) palette.chosen = 0, palette.trouble.clear();
    ImGui::Dummy({0.0F, 2.0F * theme::scale()});
    const std::string typed = palette.typed.data();
    if (palette.asks_for != nullptr)
        draw_arguments(context, *palette.asks_for, palette.asks_for->name + " " + typed, entered);
    else if (const Command* given = command_given_by(typed))
        draw_arguments(context, *given, typed, entered);
    else
        draw_found(context, entered);
    if (!palette.open) ImGui::CloseCurrentPopup();
    widgets::end_dialog();
}

} // namespace ramus::app
