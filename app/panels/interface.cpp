#include "app/panels/interface.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {
constexpr float kBarHeight = 34.0F; // points
constexpr float kStatusHeight = 28.0F;
constexpr float kLeastPanelWidth = 240.0F;
constexpr float kMostPanelWidth = 640.0F;
constexpr float kLeastViewWidth = 320.0F;  // the panel gives way in a narrow window
constexpr float kLeastViewHeight = 200.0F; // and the overview in a low one
constexpr float kLeastOverviewHeight = 90.0F;

// What to do when there is nothing to see, or why there is not yet.
void draw_empty_view(InterfaceContext& context) {
    const Preparing preparing = context.interface.preparing;
    const bool prepares = preparing == Preparing::kFirstPicture, other_case = preparing == Preparing::kOtherCase;
    if (!prepares && !other_case && (context.workspace.shown().mesh || context.workspace.document().has_scene()))
        return;
    const bool waits = prepares || context.workspace.busy();
    const char* title = prepares     ? "Preparing graphics..."
                        : other_case ? "Drawing..."
                        : waits      ? "Reading..."
                                     : "No vessel tree";
    const char* hint = prepares              ? "The graphics driver translates the shaders; mostly once for a machine"
                       : waits || other_case ? ""
                                             : "Drop a tree, a mask or a scan here, or press Ctrl+O";
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 centre(
        static_cast<float>(context.layout.view_at.x) + 0.5F * static_cast<float>(context.layout.view_size.x),
        static_cast<float>(context.layout.view_at.y) + 0.5F * static_cast<float>(context.layout.view_size.y));
    ImGui::PushFont(theme::title_font());
    const ImVec2 size = ImGui::CalcTextSize(title);
    list->AddText({std::round(centre.x - 0.5F * size.x), std::round(centre.y - size.y)},
                  ImGui::GetColorU32(theme::kOnPicture), title);
    ImGui::PopFont();
    const ImVec2 hint_size = ImGui::CalcTextSize(hint);
    list->AddText({std::round(centre.x - 0.5F * hint_size.x), std::round(centre.y + 6.0F * theme::scale())},
                  ImGui::GetColorU32(theme::kQuietOnPicture), hint);
}

// The way back, where the picture shows nothing of what there is.
void draw_way_back(InterfaceContext& context) {
    if (!context.interface.nothing_in_view) return;
    const float scale = theme::scale(), width = 190.0F * scale, height = 84.0F * scale;
    const Layout& layout = context.layout;
    const glm::vec2 corner =
        glm::vec2(layout.view_at) + 0.5F * (glm::vec2(layout.view_size) - glm::vec2(width, height));
    ImVec4 ground = theme::kBar;
    ground.w = 0.82F;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {16.0F * scale, 12.0F * scale});
    widgets::begin_fixed("nothing in view", std::round(corner.x), std::round(corner.y), width, height,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    const char* words = "Nothing is in view";
    ImGui::SetCursorPosX(std::round(0.5F * (width - ImGui::CalcTextSize(words).x)));
    ImGui::TextUnformatted(words);
    ImGui::Dummy({1.0F, 2.0F * scale});
    if (widgets::button("Fit", {ImGui::GetContentRegionAvail().x, 28.0F * scale}, theme::kAccentDim))
        context.perform("fit", {});
    widgets::tooltip("Brings all of it back into the picture", "F");
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace

Layout layout_of(glm::ivec2 window, float scale, bool panel_open, float overview_points, float panel_points) {
    const auto pixels = [&](float points) { return static_cast<int>(std::round(points * scale)); };
    Layout layout;
    layout.window = window;
    layout.bar_height = pixels(kBarHeight);
    layout.status_height = pixels(kStatusHeight);
    const int beside = window.x - pixels(kLeastViewWidth);
    if (panel_open && beside >= pixels(kLeastPanelWidth))
        layout.panel_width = std::min(pixels(std::clamp(panel_points, kLeastPanelWidth, kMostPanelWidth)), beside);
    layout.view_at = {0, layout.bar_height};
    const int between = window.y - layout.bar_height - layout.status_height;
    const int available = between - pixels(kLeastViewHeight);
    if (overview_points > 0.0F && available >= pixels(kLeastOverviewHeight))
        layout.overview_height = std::clamp(pixels(overview_points), pixels(kLeastOverviewHeight), available);
    layout.view_size =
        glm::max(glm::ivec2(window.x - layout.panel_width, between - layout.overview_height), glm::ivec2(1));
    layout.viewport_size = layout.view_size;
    return layout;
}

const char* key_of(PanelPage page) {
    return page == PanelPage::kExplore ? "explore" : page == PanelPage::kSurface ? "surface" : "plan";
}

bool Interface::dismiss() {
    if (menu_open) {
        close_menu = true;
        menu_by_keys = false;
    } else if (menu_by_keys && menu_focused) {
        menu_by_keys = false;
    } else if (context_menu.wanted) {
        context_menu.wanted = false;
    } else if (context_menu.open) {
        context_menu.close = true;
    } else if (!errors.empty()) {
        errors.pop_front();
    } else if (unsaved.open()) {
        unsaved.next = nullptr;
    } else if (quit.open()) {
        quit.next = nullptr;
    } else if (volume.open()) {
        volume = {};
    } else {
        const std::array below{&palette.open,  &recovery.open,   &open_dialog.open, &help_open,     &rename.open,
                               &radius.open,   &fly.open,        &units_panel.open, &warnings.open, &doctor.open,
                               &contacts.open, &validation.open, &welcome.open,     &written.open};
        const auto top = std::ranges::find_if(below, [](const bool* open) { return *open; });
        if (top == below.end()) return false;
        **top = false;
        fly.playing = fly.playing && fly.open;
    }
    return true;
}

void Interface::note_covered() {
    const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    covered.push_back({{from.x, from.y}, {from.x + size.x, from.y + size.y}});
}

void Interface::forget_tree() {
    hovered = tree::kNoBranch;
    nothing_in_view = false;
    list.of = nullptr;
    list.shown = list.cursor = list.anchor = tree::kNoBranch;
    overview.shown_selection = tree::kNoBranch;
    overview.layout_of = nullptr;
    rename.open = radius.open = fly.open = fly.playing = false;
    doctor.current = contacts.current = validation.current = -1;
}

void InterfaceContext::perform(const Command& command) {
    if (const auto done = commands.run(actions, command); !done)
        interface.tell(done.error(), workspace.document().lengths(), now);
}

void InterfaceContext::perform(std::string_view name, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{std::string(name)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    interface.last_command = words;
    if (const auto done = commands.run(actions, words); !done)
        interface.tell(done.error(), workspace.document().lengths(), now);
}

void draw_title(InterfaceContext& context, const char* title, std::initializer_list<widgets::TitleButton> buttons) {
    if (const auto pressed = widgets::title_row(title, buttons)) context.perform(pressed->command, pressed->words);
}

void draw_interface(InterfaceContext& context) {
    Interface& interface = context.interface;
    theme::use(interface.settings.light_theme ? theme::Kind::kLight : theme::Kind::kDark);
    interface.listed = tree::kNoBranch;
    interface.listed_lesion = {};
    interface.covered.clear();
    // Arrows and Enter work in menus alone: elsewhere they turn the view, or are the list's.
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    // From one menu to the next none is open for a frame.
    constexpr int kFramesBetweenMenus = 6;
    if (interface.want_menu) interface.menu_by_keys = true;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) interface.menu_by_keys = false;
    const bool in_menu = interface.want_menu || interface.menu_open || interface.context_menu.open ||
                         (interface.menu_by_keys && interface.menu_focused);
    interface.menu_keys = in_menu ? kFramesBetweenMenus : std::max(0, interface.menu_keys - 1);
    flags = interface.menu_keys > 0 ? flags | ImGuiConfigFlags_NavEnableKeyboard
                                    : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
    draw_empty_view(context);
    draw_way_back(context);
    draw_tool_drawing(context);
    draw_menu_bar(context);
    draw_tool_bar(context);
    draw_side_panel(context);
    draw_welcome(context);
    draw_doctor(context);
    draw_units_panel(context);
    draw_warnings(context);
    draw_contacts(context);
    draw_validation(context);
    draw_overview(context);
    draw_branch_window(context);
    draw_fly(context);
    draw_written(context);
    draw_status_bar(context);
    draw_tooltip(context);
    draw_context_menu(context);
    // Of dialogs that are open, the first one is shown.
    draw_error_dialog(context);
    draw_unsaved_dialog(context);
    draw_quit_dialog(context);
    draw_recovery_dialog(context);
    draw_volume_dialog(context);
    draw_open_dialog(context);
    draw_command_palette(context);
    draw_help(context);
    draw_radius(context);
    draw_rename(context);
}

} // namespace ramus::app
