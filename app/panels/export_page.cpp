// The export dialog's upper part: a page for each kind of file, with a preview of pictures.
#include "app/actions/case_pages.h"
#include "app/panels/figure_preview.h"
#include "app/panels/open_dialog.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/reports/table_kinds.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <imgui.h>

namespace ramus::app {

namespace {

// "1,504 branches, 2 lesions; about 5.1 MB".
std::string page_words(const InterfaceContext& context, const PageFields& page) {
    const Document& document = context.workspace.document();
    const auto& mesh = context.workspace.shown().mesh;
    if (!document.tree() || !mesh) return {};
    const PageChoice choice = page.choice();
    const std::size_t bytes = actions::expected_page_bytes(document, mesh->triangle_count(), choice);
    return "In it: " + actions::page_contents(document, choice) + ". About " +
           digits(static_cast<double>(bytes) / 1e6, 2) + " MB.";
}

Exportable exportable(const InterfaceContext& context, const ExportChoice& choice) {
    const Document& document = context.workspace.document();
    Exportable has;
    has.tree = document.tree() != nullptr;
    has.selection = !document.marks().selection.empty();
    has.systems = document.tree() && !document.tree()->systems.empty();
    const Assets& assets = context.workspace.current_assets();
    has.territories = assets.organ.territories != nullptr;
    for (const TableKind& kind : table_kinds())
        if (document.tree() && kind.there(document, assets)) has.tables.push_back(kind.name);
    if (choice.what == ExportWhat::kPage) has.page = page_words(context, choice.page);
    return has;
}

// The preview of the picture, on a checkerboard where it is transparent.
void draw_preview(FigurePreview& preview, const ImVec2& size) {
    preview.most = glm::max(glm::ivec2(glm::vec2(size.x, size.y)), glm::ivec2(1));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    widgets::note_item("Preview");
    if (preview.texture == 0) return;
    const float shrink =
        std::min(size.x / static_cast<float>(preview.size.x), size.y / static_cast<float>(preview.size.y));
    const ImVec2 shown(shrink * static_cast<float>(preview.size.x), shrink * static_cast<float>(preview.size.y));
    const ImVec2 from(std::round(at.x + size.x - shown.x), at.y), to(from.x + shown.x, from.y + shown.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float square = 8.0F * theme::scale();
    list.PushClipRect(from, to, true);
    list.AddRectFilled(from, to, IM_COL32(150, 150, 150, 255));
    for (int row = 0; static_cast<float>(row) * square < shown.y; ++row)
        for (int column = row % 2; static_cast<float>(column) * square < shown.x; column += 2) {
            const ImVec2 corner(from.x + static_cast<float>(column) * square,
                                from.y + static_cast<float>(row) * square);
            list.AddRectFilled(corner, {corner.x + square, corner.y + square}, IM_COL32(105, 105, 105, 255));
        }
    list.PopClipRect();
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(preview.texture)), from, to);
    list.AddRect(from, to, ImGui::GetColorU32(theme::kLine));
}

} // namespace

void draw_export_page(InterfaceContext& context, OpenDialog& dialog) {
    const float scale = theme::scale(), height = 252.0F * scale, preview_width = 320.0F * scale;
    FigurePreview& preview = context.interface.of<FigurePreview>();
    preview.wanted = dialog.exported.draws();
    preview.request = dialog.exported.request({});
    const Exportable has = exportable(context, dialog.exported);
    const bool other_kind = draw_export_kinds(dialog.exported, has);
    ImGui::Dummy({0.0F, 1.0F});
    const float width = ImGui::GetContentRegionAvail().x - (preview.wanted ? preview_width + 16.0F * scale : 0.0F);
    ImGui::BeginChild("export", {width, height});
    if (draw_export_choice(dialog.exported, has) || other_kind) {
        dialog.rename(dialog.exported.suggested(dialog.name.data()));
        dialog.name_focused = false; // focus the name again
    }
    const std::string trouble = dialog.exported.trouble();
    if (!trouble.empty()) widgets::trouble(trouble.c_str());
    ImGui::EndChild();
    if (preview.wanted) {
        ImGui::SameLine(0.0F, 16.0F * scale);
        draw_preview(preview, {preview_width, height});
    }
    ImGui::Dummy({0.0F, 4.0F * scale});
}

} // namespace ramus::app
