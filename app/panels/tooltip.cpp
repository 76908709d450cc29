// The card about the branch under the pointer: its size and dependents.
#include "app/panels/menu_bar.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>
#include <vector>

namespace ramus::app {

namespace {

float overlap(const Covered& a, const Covered& b) {
    const glm::vec2 size = glm::max(glm::min(a.to, b.to) - glm::max(a.from, b.from), 0.0F);
    return size.x * size.y;
}

// Areas that the card must not cover: tools, scale bar and cube at the picture's edges.
std::array<Covered, 3> kept_free(const Layout& layout, float scale) {
    const glm::vec2 from(layout.view_at), to = from + glm::vec2(layout.view_size);
    return {Covered{from, {to.x, from.y + 54.0F * scale}},
            Covered{{from.x, to.y - 70.0F * scale}, {from.x + 170.0F * scale, to.y}},
            Covered{{to.x - 110.0F * scale, to.y - 110.0F * scale}, to}};
}

} // namespace

glm::vec2 card_corner(const Layout& layout, const std::vector<Covered>& covered, glm::vec2 pointer, glm::vec2 size,
                      float scale) {
    const float gap = 16.0F * scale;
    const glm::vec2 from(0.0F, static_cast<float>(layout.bar_height));
    const glm::vec2 to(static_cast<float>(layout.window.x - layout.panel_width),
                       static_cast<float>(layout.window.y - layout.status_height));
    std::vector<float> lefts{pointer.x + gap, pointer.x - gap - size.x};
    for (const Covered& panel : covered) lefts.push_back(panel.to.x + 2.0F * scale);
    glm::vec2 best(0.0F);
    float least = FLT_MAX;
    // Tries the whole picture, then the part above scale bar and cube.
    for (const float bottom : {to.y, to.y - 110.0F * scale})
        for (const float top : {pointer.y + gap, pointer.y - gap - size.y})
            for (const float left : lefts) {
                const glm::vec2 corner = glm::max(glm::min(glm::vec2(left, top), glm::vec2(to.x, bottom) - size), from);
                const Covered card{corner, corner + size};
                float hidden = overlap(card, {pointer - gap, pointer + gap});
                for (const Covered& rect : kept_free(layout, scale)) hidden += overlap(card, rect);
                for (const Covered& rect : covered) hidden += overlap(card, rect);
                if (hidden < least) least = hidden, best = corner;
            }
    return best;
}

namespace {

// Draws the card beside the pointer; `draw()` fills it.
template <class Draw> void draw_card(InterfaceContext& context, const Draw& draw) {
    const float scale = theme::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12.0F * scale, 9.0F * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {16.0F * scale, 3.0F * scale});
    const ImVec2 mouse = ImGui::GetMousePos();
    const glm::vec2 corner =
        card_corner(context.layout, context.interface.covered, {mouse.x, mouse.y}, context.interface.card_size, scale);
    ImGui::SetNextWindowPos({std::round(corner.x), std::round(corner.y)});
    ImGui::BeginTooltip();
    draw();
    const ImVec2 size = ImGui::GetWindowSize();
    context.interface.card_size = {size.x, size.y};
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
}

void draw_object_tooltip(InterfaceContext& context, const ObjectPlace& place) {
    const Document& document = context.workspace.document();
    const ObjectWords words = words_of(place, document.marks(), context.workspace.current_assets(), document.lengths());
    draw_card(context, [&] {
        constexpr float kWidth = 320.0F;
        ImGui::PushTextWrapPos(kWidth * theme::scale());
        ImGui::TextColored(theme::kAccent, "%s", words.title.c_str());
        if (!words.value.empty()) ImGui::TextUnformatted(words.value.c_str());
        if (!words.details.empty()) widgets::quiet(words.details.c_str());
        ImGui::PopTextWrapPos();
    });
}

void draw_branch_facts(const InterfaceContext& context, int id, const BranchFacts& facts) {
    const Document& document = context.workspace.document();
    const tree::Branch& branch = document.tree()->branches[static_cast<std::size_t>(id)];
    const float scale = theme::scale();
    const std::string label = label_of(document.dependency(), document.marks(), id);
    const std::string number = "Branch " + std::to_string(id);
    ImGui::TextColored(theme::kAccent, "%s",
                       label.empty() ? number.c_str() : widgets::fitted(label, 220.0F * scale).c_str());
    if (!label.empty()) {
        ImGui::SameLine();
        widgets::quiet(number.c_str());
    }
    if (ImGui::BeginTable("facts", 2, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [](const char* name, const std::string& value, const std::string& more = {}) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            widgets::quiet(name);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(value.c_str());
            if (more.empty()) return;
            ImGui::SameLine(0.0F, 8.0F * theme::scale());
            widgets::quiet(more.c_str());
        };
        const std::string system = system_of(*document.tree(), document.marks(), id);
        if (!system.empty()) row("System", widgets::fitted(system, 180.0F * scale));
        const std::string least = digits(facts.diameter_mm.min);
        const std::string most = digits(facts.diameter_mm.max);
        const Lengths lengths = document.lengths();
        row("Diameter", lengths.text(facts.diameter_mm.mean),
            least == most ? std::string{} : least + " \xE2\x80\x93 " + most);
        row("Length", lengths.text(facts.length_mm));
        row("Generation", std::to_string(branch.generation));
        row("Strahler order", std::to_string(branch.strahler));
        if (nothing_depends(*context.workspace.facts())) {
            row("Depend on it", kNothingDepends);
        } else if (facts.dependents.branches == 0) {
            row("Depend on it", "no branches");
        } else {
            row("Depend on it", counted(static_cast<std::uint64_t>(facts.dependents.branches), "branch", "branches"));
            row("", lengths.text(facts.dependents.length_mm), lengths.volume(facts.dependents.volume_mm3));
        }
        ImGui::EndTable();
    }
}

} // namespace

void draw_branch_tooltip(InterfaceContext& context, int id) {
    const Document& document = context.workspace.document();
    if (id < 0 || id >= document.branch_count() || !context.workspace.facts()) return;
    const auto index = static_cast<std::size_t>(id);
    const BranchFacts& facts = context.workspace.facts()->branches[index];
    draw_card(context, [&] { draw_branch_facts(context, id, facts); });
}

void draw_tooltip(InterfaceContext& context) {
    const Interface& interface = context.interface;
    if (!interface.tooltip || interface.of<BarMenus>().have_keys()) return;
    if (interface.pointed)
        draw_object_tooltip(context, *interface.pointed);
    else
        draw_branch_tooltip(context, interface.hovered);
}

} // namespace ramus::app
