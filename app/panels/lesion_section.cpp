// The lesions of the planning page: their nearest vessels, and the contents of their margins.
#include "app/assets/lesion_text.h"
#include "app/panels/choice_row.h"
#include "app/panels/editing.h"
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

// A clickable line, an editable diameter, and a cross.
void draw_lesion(InterfaceContext& context, std::size_t index, const Lesion& lesion) {
    const std::array<double, 4>& sphere = lesion.sphere;
    const std::string number = std::to_string(index + 1);
    const float cross = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
    const std::string unit = context.workspace.document().lengths().unit();
    const float behind = ImGui::CalcTextSize(unit.c_str()).x + cross + 2.0F * gap;
    constexpr float kField = 56.0F;
    ImGui::PushID(("lesion" + number).c_str());
    plan_rows::object_controls(context, plan_rows::row_of(context, lesion, index));
    ImGui::AlignTextToFramePadding();
    const float sign = ImGui::CalcTextSize("\xC3\x98").x + gap;
    const float line = ImGui::GetContentRegionAvail().x - behind - kField * theme::scale() - gap - sign;
    const std::string name = lesion.name.empty() ? "Lesion " + number : lesion.name;
    if (ImGui::Selectable((widgets::fitted(name, std::max(1.0F, line)) + "##lesion").c_str(), false,
                          ImGuiSelectableFlags_AllowDoubleClick, {std::max(1.0F, line), 0.0F})) {
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            context.perform("object-name", {"lesion", number});
        else
            context.perform("object-centre", {"lesion", number});
    }
    widgets::tooltip((name + ": click to bring it to the middle of the picture, double-click to name it").c_str());
    ImGui::SameLine();
    widgets::quiet("\xC3\x98");
    ImGui::SameLine();
    const auto words =
        plan_rows::number_field(context, ("lesion " + number).c_str(), rounded(2.0 * sphere[3]), kField, behind);
    widgets::tooltip(("Diameter of lesion " + number + "; Enter takes it").c_str());
    ImGui::SameLine();
    widgets::quiet(unit.c_str());
    ImGui::SameLine();
    widgets::align_right(cross);
    const bool removed = widgets::button("\xC3\x97", {cross, 0.0F}, theme::kNothing, theme::kQuiet);
    widgets::tooltip("Remove");
    ImGui::PopID();
    if (removed) return context.perform("lesion-remove", {number});
    if (words.size() != 1) return;
    const auto diameter = parsed<double>(words[0]);
    const std::string radius = diameter ? exact_text(0.5 * *diameter) : words[0];
    context.perform("lesion-change", {number, exact_text(sphere[0]) + "," + exact_text(sphere[1]) + "," +
                                                  exact_text(sphere[2]) + "," + radius});
}

// The shortest distance to the vessels of each system, and the contact. A click moves the camera there.
void draw_vessels(InterfaceContext& context, std::size_t lesion) {
    const Document& document = context.workspace.document();
    const auto plan = context.workspace.current_assets().plan; // keeps it alive, as below
    const tree::VesselTree& tree = *document.tree();
    const Lengths lengths = document.lengths();
    const float indent = 10.0F * theme::scale();
    for (const measure::LesionVessels& vessels : plan->vessels) {
        const measure::NearestWall& nearest = vessels.nearest;
        if (vessels.lesion != lesion || nearest.branch == tree::kNoBranch) continue;
        const std::string name = vessels_name(tree, document.marks(), vessels);
        const std::string distance = distance_text(nearest, lengths),
                          branch = plan_rows::branch_name(document, nearest.branch);
        const std::string contact = contact_text(vessels, lengths), brief = contact.substr(0, contact.rfind(" over "));
        const std::string away = nearest.overlap_mm > 0.0 ? "overlap " + lengths.text(nearest.overlap_mm) : distance;
        const std::string number = std::to_string(lesion + 1);
        ImGui::PushID(vessels.system);
        ImGui::Indent(indent);
        ImGui::PushFont(theme::small_font());
        const float right = ImGui::CalcTextSize(away.c_str()).x + 6.0F * theme::scale();
        const float room = ImGui::GetContentRegionAvail().x;
        const ImVec2 at = ImGui::GetCursorPos();
        const float lines = vessels.touched > 0 ? 2.0F : 1.0F;
        if (ImGui::Selectable("##vessels", false, 0, {room, lines * ImGui::GetTextLineHeight() + 2.0F})) {
            std::vector<std::string> words{number};
            if (tree.systems.size() > 1) words.push_back(std::to_string(vessels.system + 1));
            context.perform("lesion-vessel", words);
        }
        if (ImGui::IsItemHovered()) {
            context.interface.listed = nearest.branch;
            context.interface.listed_lesion = {static_cast<int>(lesion), vessels.system};
        }
        widgets::tooltip(
            (name + ", " + branch + ": " + distance + " from the lesion to the vessel's wall, " + contact +
             lengths.worded(" (within " + rounded(document.marks().planning.touch_mm) + " mm). Click to go there"))
                .c_str());
        const ImVec2 after = ImGui::GetCursorPos();
        ImGui::SetCursorPos(at);
        ImGui::TextUnformatted(widgets::fitted(name + ", " + branch, room - right).c_str());
        ImGui::SameLine();
        widgets::quiet_right(away);
        if (vessels.touched > 0) {
            ImGui::SetCursorPos({at.x, at.y + ImGui::GetTextLineHeight()});
            widgets::quiet(widgets::fitted(vessels.touched > 1 ? brief : contact, room).c_str());
        }
        ImGui::SetCursorPos(after);
        ImGui::PopFont();
        ImGui::Unindent(indent);
        ImGui::PopID();
    }
}

void draw_lesion_mesh(InterfaceContext& context, std::size_t index, const Lesion& lesion) {
    plan_rows::object_row(context, plan_rows::row_of(context, lesion, index));
    ImGui::PushID(lesion.file.c_str());
    const auto mesh = lesion.of_mask() ? nullptr : context.workspace.assets().lesion_mesh(lesion);
    if (mesh && mesh->claims.orientation != tree::SaidBy::kFile)
        if (const auto axes = widgets::mesh_axes_row(lesion.axes))
            context.perform("lesion-axes", {std::to_string(index + 1), *axes});
    ImGui::PopID();
}

void set_up_band_columns(const Lengths& lengths, bool systems) {
    constexpr std::array<std::pair<const char*, const char*>, 5> kHeadings{
        {{"Branch", "The branch, by its name or its number"},
         {"System", "The vessel system that it belongs to"},
         {"\xC3\x98 mm", "Mean diameter, mm"},
         {"Away mm", "From the lesion to the vessel's wall, mm"},
         {"Deps", "How many branches depend on it"}}};
    const auto left_out = [&](std::size_t n) { return n == 1 && !systems; };
    ImGui::TableSetupScrollFreeze(0, 1);
    constexpr std::size_t kTexts = 2; // text columns share the remaining width
    for (std::size_t n = 0; n < kHeadings.size(); ++n) {
        if (left_out(n)) continue;
        const std::string text = lengths.worded(kHeadings[n].first);
        const float width = std::max(ImGui::CalcTextSize(text.c_str()).x, ImGui::CalcTextSize("0,000").x);
        ImGui::TableSetupColumn(text.c_str(),
                                n < kTexts ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed,
                                n < kTexts ? 1.0F : width);
    }
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (std::size_t n = 0; n < kHeadings.size(); ++n)
        if (!left_out(n) && ImGui::TableNextColumn())
            widgets::column_heading(lengths.worded(kHeadings[n].first).c_str(), lengths.worded(kHeadings[n].second),
                                    n < kTexts ? widgets::HeadingAt::kLeft : widgets::HeadingAt::kRight);
}

void draw_band_row(InterfaceContext& context, const measure::BandRow& row, bool systems) {
    const Document& document = context.workspace.document();
    const auto named = document.marks().names.find(row.branch);
    const std::string name = named == document.marks().names.end() ? std::to_string(row.branch) : named->second;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string shown = widgets::fitted(name, ImGui::GetContentRegionAvail().x);
    ImGui::PushID(row.branch);
    const bool pressed = ImGui::Selectable(shown.c_str(), is_selected(document.marks(), row.branch),
                                           ImGuiSelectableFlags_SpanAllColumns);
    if (shown != name) widgets::tooltip(name.c_str());
    if (ImGui::IsItemHovered()) context.interface.listed = row.branch;
    ImGui::PopID();
    if (systems) {
        ImGui::TableNextColumn();
        const std::string system = system_of(*document.tree(), document.marks(), row.branch);
        ImGui::TextUnformatted(widgets::fitted(system, ImGui::GetContentRegionAvail().x).c_str());
    }
    for (const std::string& text : {digits(row.mean_diameter_mm), digits(row.distance_mm, 2),
                                    grouped(static_cast<std::uint64_t>(row.dependents.branches))}) {
        ImGui::TableNextColumn();
        widgets::text_right(text);
    }
    if (pressed) plan_rows::go_to(context, row.branch);
}

void draw_band(InterfaceContext& context, const measure::Band& band) {
    const std::string title = (band.from_mm > 0.0 ? rounded(band.from_mm) : "0") + " \xE2\x80\x93 " +
                              rounded(band.to_mm) + " " + context.workspace.document().lengths().unit();
    const std::string count = counted(band.rows.size(), "branch", "branches");
    ImGui::PushID(static_cast<int>(std::lround(1000.0 * band.to_mm)));
    const bool open = ImGui::TreeNodeEx("band", ImGuiTreeNodeFlags_SpanAvailWidth, "%s", title.c_str());
    ImGui::SameLine();
    widgets::quiet_right(count);
    if (open) {
        constexpr ImGuiTableFlags kFlags =
            ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
        ImGui::PushFont(theme::small_font());
        const float indent = ImGui::GetStyle().IndentSpacing; // the columns need all the room there is
        ImGui::Unindent(indent);
        const float row_height = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
        const float rows = static_cast<float>(std::min<std::size_t>(band.rows.size(), 8) + 1);
        const bool systems = context.workspace.document().tree()->systems.size() > 1;
        if (!band.rows.empty() &&
            ImGui::BeginTable("rows", systems ? 5 : 4, kFlags, {0.0F, rows * row_height + 2.0F})) {
            set_up_band_columns(context.workspace.document().lengths(), systems);
            widgets::clipped(band.rows.size(), [&](std::size_t n) { draw_band_row(context, band.rows[n], systems); });
            ImGui::EndTable();
        }
        ImGui::Indent(indent);
        ImGui::PopFont();
        ImGui::TreePop();
    }
    ImGui::PopID();
}

} // namespace

void draw_lesions(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    if (!draw_section(context, "Lesions",
                      {{"Place", "Place a lesion in the picture and size it by dragging", "tool", {"lesion"}},
                       {"Mesh\xE2\x80\xA6", "Read a closed mesh from a file: STL, PLY or OBJ", "lesion-mesh"},
                       {"Mask\xE2\x80\xA6", "Read the parts of a mask from a file, each a lesion", "lesion-mask"}}))
        return;
    if (marks.lesions.empty()) {
        widgets::quiet_wrapped(
            "What lies near a lesion, and how near, is listed here. A closed mesh (STL, PLY, OBJ) dropped into the "
            "picture now is a lesion too, and the parts of a mask can be.");
        return;
    }
    widgets::row_headings(
        {"Lesion", "Click a line to bring the lesion to the middle of the picture"},
        {"Diameter",
         "The diameter of a sphere; of a mesh or a part of a mask, the greatest distance between two places of "
         "its surface; of a part also the volume of its voxels"},
        ImGui::GetFrameHeight());
    // Keeps the list alive: actions of rows replace it.
    const auto same = [&, before = marks] { return planned(before) == planned(context.workspace.document().marks()); };
    for (const auto lesions = marks.lesions; const Lesion& lesion : lesions) {
        const auto index = static_cast<std::size_t>(&lesion - lesions.data());
        if (lesion.is_mesh())
            draw_lesion_mesh(context, index, lesion);
        else
            draw_lesion(context, index, lesion);
        if (same()) draw_vessels(context, index);
    }
    bool shown = marks.shortest_distances;
    if (ImGui::Checkbox("Shortest distances", &shown)) context.perform("shortest-distances", {shown ? "on" : "off"});
    widgets::tooltip("Draws a line with its length from each lesion to the nearest vessel of each system");
    plan_rows::field_label(context, "Contact within (mm)");
    if (const auto words = plan_rows::number_field(context, "contact", rounded(marks.planning.touch_mm), 56.0F);
        words.size() == 1)
        context.perform("lesion-contact", words);
    widgets::tooltip("A vessel whose wall is this near to a lesion counts as touching it; half the edge of the scan's "
                     "voxels is a good value. Enter takes it");
    const auto plan = context.workspace.current_assets().plan;
    if (plan->measuring) widgets::quiet("Distances to meshes are being measured");
    for (const std::string& trouble : plan->troubles) widgets::trouble(trouble.c_str());
}

void draw_margins(InterfaceContext& context) {
    const Document& document = context.workspace.document();
    const Marks& marks = document.marks();
    if (marks.lesions.empty() || is_closed(context, "Lesions")) return;
    ImGui::Dummy({0.0F, 3.0F * theme::scale()});
    plan_rows::field_label(context, "Margins (mm)");
    if (const auto words =
            plan_rows::number_field(context, "bands", joined(marks.planning.bands_mm, "  ", rounded), 110.0F);
        !words.empty())
        context.perform("bands", words);
    widgets::tooltip("Distances from the lesion to the vessel's wall that divide the list; Enter takes them");
    bool coloured = marks.colour_by == ColourBy::kLesion;
    if (ImGui::Checkbox("Colour vessels by distance", &coloured)) {
        // Switching it off restores the previous colouring.
        std::string& before = context.interface.of<Editing>().colours_before;
        const std::string usual = document.tree()->systems.size() > 1 ? "system" : "nothing";
        if (coloured) before = name_of(marks.colour_by);
        context.perform("colour-by", {coloured ? "lesion" : before.empty() ? usual : before});
        if (!coloured) before.clear();
    }
    widgets::tooltip("Distances to lesions as colours");
    const auto plan = context.workspace.current_assets().plan;
    if (!plan->bands.empty())
        widgets::row_headings({"Away from the lesion", "From the lesion to the vessel's wall"},
                              {"Vessels", "How many branches lie there"});
    for (const measure::Band& band : plan->bands) draw_band(context, band);
}

} // namespace ramus::app
