#include "app/panels/flat_map_view.h"

#include "app/panels/plan_rows.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "render/overlay/scale_bar.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <imgui.h>

namespace ramus::app {

namespace {

ImU32 opaque(const glm::vec3& colour) { return widgets::packed(glm::vec4(colour, 1.0F)); }

// From the map to the window.
struct Placement {
    const FlatMap& map;
    ImVec2 corner; // upper left
    float scale;   // pixels per mm
    [[nodiscard]] ImVec2 at(const glm::vec2& place) const {
        return {corner.x + scale * (place.x - map.box.least.x), corner.y + scale * (map.box.most.y - place.y)};
    }
};

void draw_triangles(ImDrawList& list, const Placement& placement) {
    // Edges that are smoothed would show as seams.
    const ImDrawListFlags before = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (const FlatMap::Band& band : placement.map.bands)
        for (const auto& [a, b, c] : band.triangles)
            list.AddTriangleFilled(placement.at(a), placement.at(b), placement.at(c), opaque(band.colour));
    list.Flags = before;
}

void draw_sides(ImDrawList& list, const FlatMap& map, ImVec2 from, ImVec2 to, const render::AxisNames& names) {
    const auto text = [&](std::size_t side, float across, float down) {
        const ImVec2 size = ImGui::CalcTextSize(names[map.sides[side]].c_str());
        list.AddText({from.x + across * (to.x - from.x - size.x), from.y + down * (to.y - from.y - size.y)},
                     ImGui::ColorConvertFloat4ToU32(theme::kQuiet), names[map.sides[side]].c_str());
    };
    text(0, 0.0F, 0.5F);
    text(1, 1.0F, 0.5F);
    text(2, 0.5F, 1.0F);
    text(3, 0.5F, 0.0F);
}

// The vessel under the pointer; null: none.
const FlatMap::Vessel* draw_vessels(ImDrawList& list, const Placement& placement) {
    const float least = 2.0F * theme::scale();
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const FlatMap::Vessel* under = nullptr;
    for (const FlatMap::Vessel& vessel : placement.map.vessels) {
        const ImVec2 at = placement.at(vessel.at);
        const float radius = std::max(least, placement.scale * vessel.radius_mm);
        list.AddCircleFilled(at, radius, opaque(vessel.colour));
        list.AddCircle(at, radius, IM_COL32(20, 22, 26, 255), 0, 1.0F);
        if (glm::distance(glm::vec2(pointer.x, pointer.y), glm::vec2(at.x, at.y)) <= radius + least) under = &vessel;
    }
    return under;
}

void draw_nearest(ImDrawList& list, const Placement& placement) {
    const float size = 4.5F * theme::scale();
    for (const FlatMap::Nearest& nearest : placement.map.nearest) {
        const ImVec2 at = placement.at(nearest.at);
        list.AddNgonFilled(at, size + 1.5F, IM_COL32(255, 255, 255, 255), 4);
        list.AddNgonFilled(at, size, IM_COL32(20, 22, 26, 255), 4);
    }
}

void draw_scale(ImDrawList& list, const Placement& placement, ImVec2 at, const Lengths& lengths) {
    const double length = render::scale_bar_length_mm(0.4 * double(placement.map.box.size().x));
    const float width = placement.scale * static_cast<float>(length);
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
    list.AddRectFilled(at, {at.x + width, at.y + 2.0F * theme::scale()}, ink);
    list.AddText({at.x + width + 5.0F * theme::scale(), at.y - 0.5F * ImGui::GetTextLineHeight()}, ink,
                 (rounded(length) + " " + lengths.unit()).c_str());
}

void draw_legend(const FlatMap& map, const Lengths& lengths) {
    for (const FlatMap::Nearest& nearest : map.nearest)
        widgets::fact(("Margin of " + nearest.lesion).c_str(), lengths.text(nearest.margin_mm));
    if (map.bands.empty() || map.bands.front().distance.empty()) return;
    widgets::quiet(("Distance to lesion (" + lengths.unit() + ")").c_str());
    const float size = ImGui::GetTextLineHeight(), gap = 8.0F * theme::scale();
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (std::size_t n = 0; n < map.bands.size(); ++n) {
        const FlatMap::Band& band = map.bands[n];
        const float width = size + ImGui::CalcTextSize(band.distance.c_str()).x;
        if (n > 0 && ImGui::GetItemRectMax().x + gap + width < right) ImGui::SameLine(0.0F, gap);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        widgets::patch(at, band.colour);
        ImGui::SetCursorScreenPos({at.x + size, at.y});
        ImGui::TextUnformatted(band.distance.c_str());
    }
}

} // namespace

void draw_flat_map(InterfaceContext& context, const FlatMap& map, const tree::Claims& claims) {
    const Lengths lengths(claims);
    ImGui::PushFont(theme::small_font());
    const float line = ImGui::GetTextLineHeight(), most_height = 190.0F * theme::scale();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const glm::vec2 room(ImGui::GetContentRegionAvail().x - 2.0F * line, most_height - 2.0F * line);
    const glm::vec2 size = glm::max(map.box.size(), glm::vec2(1e-6F));
    const float scale = std::min(room.x / size.x, room.y / size.y);
    const ImVec2 whole{ImGui::GetContentRegionAvail().x, scale * size.y + 2.0F * line};
    const Placement placement{map, {from.x + 0.5F * (whole.x - scale * size.x), from.y + line}, scale};
    ImGui::InvisibleButton("map", {whole.x, whole.y + 1.3F * line});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_triangles(list, placement);
    const FlatMap::Vessel* under = draw_vessels(list, placement);
    draw_nearest(list, placement);
    draw_sides(list, map, {placement.corner.x - line, from.y},
               {placement.corner.x + scale * size.x + line, from.y + whole.y},
               claims.has_sides() ? render::side_letters() : render::plain_axes());
    draw_scale(list, placement, {from.x, from.y + whole.y + 0.6F * line}, lengths);
    if (under != nullptr && ImGui::IsItemHovered()) {
        context.interface.listed = under->branch;
        widgets::tooltip((plan_rows::branch_name(context.workspace.document(), under->branch) + ", \xC3\x98 " +
                          lengths.text(under->diameter_mm))
                             .c_str());
        if (ImGui::IsItemClicked()) plan_rows::go_to(context, under->branch);
    } else {
        widgets::tooltip("The cut surface laid flat, as it is seen after the part is removed. Circles are vessels that "
                         "are cut; the diamond is the place of the margin");
    }
    draw_legend(map, lengths);
    ImGui::PopFont();
}

} // namespace ramus::app
