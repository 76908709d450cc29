// The notice of the last file written, with a button for its folder. Stays at the lower edge of the picture until
// dismissed.
#include "app/panels/written_notice.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

void draw_written(InterfaceContext& context) {
    Written& written = context.interface.of<Written>();
    if (!written.open) return;
    const float scale = theme::scale(), height = 44.0F * scale;
    const float button = 104.0F * scale, cross = ImGui::GetFrameHeight(), gap = 10.0F * scale;
    const Layout& layout = context.layout;
    const auto view = static_cast<float>(layout.view_size.x);
    const float most = std::min(view - 24.0F * scale, 760.0F * scale),
                rest = button + cross + 2.0F * gap + 28.0F * scale;
    const std::string sentence = widgets::fitted(written.sentence, most - rest);
    const float width = std::min(most, ImGui::CalcTextSize(sentence.c_str()).x + rest);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::kBar);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14.0F * scale, 8.0F * scale});
    widgets::begin_fixed("written", std::round(static_cast<float>(layout.view_at.x) + 0.5F * (view - width)),
                         static_cast<float>(layout.view_at.y + layout.view_size.y) - height - 12.0F * scale, width,
                         height, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    context.interface.note_covered();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(sentence.c_str());
    widgets::tooltip(written.file.c_str());
    ImGui::SameLine();
    widgets::align_right(button + cross + gap);
    if (widgets::button("Open folder", {button, 0.0F}, theme::kAccentDim)) context.perform("open-folder", {});
    widgets::tooltip("Shows the file's folder in the desktop's file manager");
    ImGui::SameLine(0.0F, gap);
    if (widgets::button("\xC3\x97", {cross, 0.0F}, theme::kNothing, theme::kQuiet)) written.open = false;
    widgets::tooltip("Puts this away");
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace ramus::app
