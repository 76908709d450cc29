#include "app/panels/interface.h"

#include "app/panels/contacts_panel.h"
#include "app/panels/context_menu.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/editing.h"
#include "app/panels/fly_panel.h"
#include "app/panels/menu_bar.h"
#include "app/panels/overview.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/validation_panel.h"
#include "app/panels/warnings_panel.h"
#include "app/panels/widgets.h"
#include "app/panels/written_notice.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <iterator>
#include <set>
#include <string>
#include <utility>

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
    switch (page) {
    case PanelPage::kExplore:
        return "explore";
    case PanelPage::kSurface:
        return "surface";
    case PanelPage::kSlices:
        return "slices";
    case PanelPage::kPlan:
        break;
    }
    return "plan";
}

bool Interface::dismiss() {
    auto& menus = of<BarMenus>();
    auto& menu = of<ContextMenu>();
    if (menus.open)
        menus.close = true, menus.by_keys = false;
    else if (menus.by_keys && menus.focused)
        menus.by_keys = false;
    else if (menu.wanted)
        menu.wanted = false;
    else if (menu.open)
        menu.close = true;
    else if (const auto* dialog =
                 std::ranges::find_if(kDialogs, [&](const DialogRow& row) { return row.is_open(*this); });
             dialog != std::end(kDialogs))
        dialog->close(*this);
    else if (auto& fly = of<Fly>(); fly.open)
        fly.close();
    else if (left_panel != typeid(void))
        close_left();
    else
        return std::exchange(of<Written>().open, false);
    return true;
}

bool Interface::dialog_open() const {
    return std::ranges::any_of(kDialogs, [&](const DialogRow& row) { return row.is_open(*this); });
}

bool Interface::between_menus() const {
    return of<BarMenus>().keys > 0 && !of<BarMenus>().open && !of<ContextMenu>().open;
}

void Interface::tell(std::string text, double now, bool trouble) {
    notice = {window_words(std::move(text)), now + 5.0, trouble};
}

void Interface::tell(const Error& error, const Lengths& lengths, double now) {
    tell(lengths.worded(error.message()), now, true);
    if (!error.where.empty()) of<WarningsPanel>().list.add(in_window_words(error));
}

void Interface::warn(Warning warning, double now) {
    tell(warning.what, now, true);
    warning.what = window_words(std::move(warning.what));
    warning.remedy = window_words(std::move(warning.remedy));
    of<WarningsPanel>().list.add(std::move(warning));
}

void Interface::note_covered() {
    const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    covered.push_back({{from.x, from.y}, {from.x + size.x, from.y + size.y}});
}

void Interface::forget_tree() {
    hovered = tree::kNoBranch;
    pointed.reset();
    nothing_in_view = false;
    auto& list = of<BranchList>();
    list.of = nullptr;
    list.shown = list.cursor = list.anchor = tree::kNoBranch;
    of<Overview>().shown_selection = tree::kNoBranch;
    of<Overview>().layout_of = nullptr;
    of<Rename>().open = of<RadiusDialog>().open = false;
    of<Fly>().close();
    of<Doctor>().current = of<ContactList>().current = of<ValidationList>().current = -1;
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

bool draw_section(InterfaceContext& context, const char* title, std::initializer_list<widgets::TitleButton> buttons) {
    bool closed = is_closed(context, title);
    std::set<std::string>& all = context.interface.of<Editing>().closed;
    if (const auto pressed = widgets::title_row(title, buttons, &closed)) {
        closed = false; // what it does is seen there
        context.perform(pressed->command, pressed->words);
    }
    if (closed)
        all.insert(title);
    else
        all.erase(title);
    return !closed;
}

bool is_closed(InterfaceContext& context, const char* title) {
    return context.interface.of<Editing>().closed.contains(title);
}

void draw_interface(InterfaceContext& context) {
    Interface& interface = context.interface;
    theme::use(interface.settings.light_theme ? theme::Kind::kLight : theme::Kind::kDark);
    interface.listed = tree::kNoBranch;
    interface.listed_lesion = {};
    interface.tried_objects.reset();
    interface.covered.clear();
    // Arrows and Enter work in menus alone: elsewhere they turn the view, or are the list's.
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    // From one menu to the next none is open for a frame.
    constexpr int kFramesBetweenMenus = 6;
    auto& menus = interface.of<BarMenus>();
    if (menus.wanted) menus.by_keys = true;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) menus.by_keys = false;
    const bool in_menu =
        menus.wanted || menus.open || interface.of<ContextMenu>().open || (menus.by_keys && menus.focused);
    menus.keys = in_menu ? kFramesBetweenMenus : std::max(0, menus.keys - 1);
    flags = menus.keys > 0 ? flags | ImGuiConfigFlags_NavEnableKeyboard : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
    draw_empty_view(context);
    draw_way_back(context);
    draw_tool_drawing(context);
    draw_menu_bar(context);
    draw_tool_bar(context);
    draw_side_panel(context);
    for (const auto& draw : kLeftPanels) draw(context);
    draw_overview(context);
    draw_branch_window(context);
    draw_fly(context);
    draw_written(context);
    draw_status_bar(context);
    draw_tooltip(context);
    draw_context_menu(context);
    for (const DialogRow& dialog : kDialogs) dialog.draw(context);
}

} // namespace ramus::app
