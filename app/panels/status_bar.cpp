// The status bar: at the left the path from the root to the current branch, at the right progress or facts of the
// picture, and the number of unread warnings.
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/picture/slices.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

constexpr const char* kStep = "  \xE2\x80\xBA  "; // an angle quote

// The branch of the path: the hovered one, or the only selected one.
int branch_at_hand(const InterfaceContext& context) {
    if (context.interface.hovered != tree::kNoBranch) return context.interface.hovered;
    const auto& selection = context.workspace.document().marks().selection;
    return selection.size() == 1 ? selection.front() : tree::kNoBranch;
}

void draw_sentence(const std::string& sentence, float width, const ImVec4& colour = theme::kQuiet) {
    const std::string shown = widgets::fitted(sentence, width);
    ImGui::TextColored(colour, "%s", shown.c_str());
    if (shown != sentence) widgets::tooltip(sentence.c_str());
}

// The place under the pointer on a slice, and the value of the first scan there.
void draw_slice_place(InterfaceContext& context) {
    const auto& place = context.interface.slice_place;
    if (!place) return;
    const Session& session = context.workspace.document().session();
    const Assets& assets = context.workspace.assets();
    ImGui::TextColored(theme::kText, "%s", place_words(*place, slice_claims(session, assets)).c_str());
    ImGui::SameLine(0.0F, 18.0F * theme::scale());
    const std::string value = value_words(*place, session, assets);
    if (value.empty()) return;
    ImGui::TextColored(theme::kText, "%s", value.c_str());
    ImGui::SameLine(0.0F, 18.0F * theme::scale());
}

void draw_path(InterfaceContext& context, float right_edge) {
    draw_slice_place(context);
    const int branch = branch_at_hand(context);
    const auto& tree = context.workspace.document().tree();
    if (branch == tree::kNoBranch || !tree) {
        if (context.workspace.document().has_scene())
            draw_sentence(tree ? "Drag to turn, wheel to zoom, click to select, F1 for all keys"
                               : "Drag to turn, wheel to zoom, F1 for all keys",
                          right_edge - ImGui::GetCursorPosX() - 24.0F * theme::scale());
        return;
    }
    const std::vector<int> path = path_to(*tree, branch);
    // The end of the path matters most: omits the middle if space is short.
    const float step_width = ImGui::CalcTextSize(kStep).x;
    float available = right_edge - ImGui::GetCursorPosX() - 24.0F * theme::scale();
    std::size_t shown_from = path.size();
    for (std::size_t i = path.size(); i-- > 1;) {
        available -= ImGui::CalcTextSize(std::to_string(path[i]).c_str()).x + step_width;
        if (available < 3.0F * step_width + 2.0F * ImGui::CalcTextSize("00000").x) break;
        shown_from = i;
    }
    const auto link = [&](int id, bool last) {
        ImGui::PushID(id);
        const auto name = context.workspace.document().marks().names.find(id);
        const std::string text =
            name == context.workspace.document().marks().names.end() ? std::to_string(id) : name->second;
        ImGui::TextColored(last ? theme::kText : theme::kQuiet, "%s", text.c_str());
        if (ImGui::IsItemHovered()) context.interface.listed = id;
        if (ImGui::IsItemClicked()) context.perform("select", {std::to_string(id)});
        ImGui::PopID();
    };
    widgets::quiet("Path");
    ImGui::SameLine(0.0F, 12.0F * theme::scale());
    link(path.front(), path.size() == 1);
    if (shown_from > 1 && path.size() > 1) {
        ImGui::SameLine(0.0F, 0.0F);
        widgets::quiet((std::string(kStep) + "\xE2\x80\xA6").c_str());
    }
    for (std::size_t i = std::max<std::size_t>(shown_from, 1); i < path.size(); ++i) {
        ImGui::SameLine(0.0F, 0.0F);
        ImGui::TextDisabled("%s", kStep);
        ImGui::SameLine(0.0F, 0.0F);
        link(path[i], i + 1 == path.size());
    }
}

float draw_progress(InterfaceContext& context) {
    const float scale = theme::scale();
    const bool command = context.commands.busy();
    const std::string text = command ? context.commands.activity() : context.workspace.activity();
    const float bar_width = std::min(140.0F * scale, 0.14F * static_cast<float>(context.layout.window.x));
    const float button_width = 60.0F * scale;
    const float text_width = ImGui::CalcTextSize(text.c_str()).x;
    const float start = static_cast<float>(context.layout.window.x) - 14.0F * scale - button_width - bar_width -
                        text_width - 24.0F * scale;
    ImGui::SetCursorPosX(start);
    widgets::quiet(text.c_str());
    ImGui::SameLine(0.0F, 12.0F * scale);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = 4.0F * scale;
    const float top = std::round(at.y + 0.5F * (ImGui::GetTextLineHeight() - height));
    const float done = std::clamp(command ? context.commands.progress() : context.workspace.progress(), 0.0F, 1.0F);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({at.x, top}, {at.x + bar_width, top + height}, ImGui::GetColorU32(theme::kLine), 0.5F * height);
    if (done > 0.0F)
        list->AddRectFilled({at.x, top}, {at.x + std::max(height, bar_width * done), top + height},
                            ImGui::GetColorU32(theme::kAccent), 0.5F * height);
    ImGui::Dummy({bar_width, ImGui::GetTextLineHeight()});
    ImGui::SameLine(0.0F, 12.0F * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {6.0F * scale, 0.0F});
    const bool cancelled = ImGui::Button("Cancel", {button_width, 0.0F});
    widgets::note_item("Cancel what goes on");
    if (cancelled) {
        context.commands.cancel();
        context.workspace.cancel_work();
    }
    ImGui::PopStyleVar();
    return start;
}

// In at most half of the bar: a narrow window omits the time first, then the kind.
float draw_facts(InterfaceContext& context) {
    const ReadySurface& shown = context.workspace.shown();
    const Marks& marks = context.workspace.document().marks();
    const bool marked = !marks.states.empty() || !marks.selection.empty(); // these marks need room
    const float available = (marked ? 0.25F : 0.5F) * static_cast<float>(context.layout.window.x);
    std::string text;
    if (context.interface.preparing == Preparing::kPicture) {
        text = "Preparing the picture...";
    } else if (shown.mesh) {
        const bool cones = shown.request.options.method == mesh::Method::kTruncatedCones;
        const field::KernelKind kernel = shown.request.options.kernel;
        std::string kind(cones ? "Cones" : "Convolution surface");
        if (!cones && kernel != field::KernelKind::kGaussian)
            kind.append(" (").append(field::row_of(kernel).label).append(")");
        const std::string count = grouped(shown.mesh->triangle_count()) + " triangles";
        for (const std::string& fitting :
             {kind + "   " + count + "   " + seconds_text(shown.seconds), kind + "   " + count, count}) {
            text = fitting;
            if (ImGui::CalcTextSize(text.c_str()).x <= available) break;
        }
    }
    const float start =
        static_cast<float>(context.layout.window.x) - 14.0F * theme::scale() - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(start);
    widgets::quiet(text.c_str());
    return start;
}

} // namespace

void draw_status_bar(InterfaceContext& context) {
    const Layout& layout = context.layout;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::kBar);
    const float padding = std::floor(0.5F * (static_cast<float>(layout.status_height) - ImGui::GetFontSize()));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14.0F * theme::scale(), padding});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    widgets::begin_fixed("status bar", 0.0F, static_cast<float>(layout.window.y - layout.status_height),
                         static_cast<float>(layout.window.x), static_cast<float>(layout.status_height),
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2);
    const ImVec2 left = ImGui::GetCursorPos();
    const float right =
        context.workspace.busy() || context.commands.busy() ? draw_progress(context) : draw_facts(context);
    ImGui::SetCursorPos(left);
    const float warned = draw_warning_mark(context, right);
    ImGui::SetCursorPos(left);
    const float edge = draw_state_marks(context, warned);
    ImGui::SetCursorPos(left);
    const Notice& notice = context.interface.notice;
    const float room = edge - left.x - 24.0F * theme::scale();
    if (context.now < notice.until)
        draw_sentence(notice.text, room, notice.trouble ? theme::kTrouble : theme::kText);
    else if (context.interface.tool)
        draw_sentence(context.interface.tool->hint(), room);
    else
        draw_path(context, edge);
    ImGui::End();
    ImGui::PopStyleColor();
}

} // namespace ramus::app
