#include "app/panels/widgets.h"

#include "app/panels/theme.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ramus::app::widgets {

namespace {

Controls* noted = nullptr;
int dialog_frame = -1; // ImGui frame of the last dialog

} // namespace

void note_controls(Controls* controls) { noted = controls; }

void note(const char* words, const ImVec2& from, const ImVec2& to) {
    if (noted == nullptr) return;
    const auto pixels = [](float length) { return static_cast<int>(std::lround(length)); };
    (*noted)[words] = {pixels(from.x), pixels(from.y), pixels(to.x - from.x), pixels(to.y - from.y)};
}

void note_item(const char* words) { note(words, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }

void begin_fixed(const char* name, float x, float y, float width, float height, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({x, y});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::Begin(name, nullptr,
                 flags | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNavInputs);
    ImGui::PopStyleVar(2);
}

bool begin_dialog(const char* name, float width, float height) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float scale = theme::scale();
    const float margin = 24.0F * scale;
    // Two dialogs would close each other in alternate frames, and neither would be visible.
    if (std::exchange(dialog_frame, ImGui::GetFrameCount()) == ImGui::GetFrameCount()) return false;
    if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
    ImGui::SetNextWindowPos({std::round(0.5F * window.x), std::round(0.5F * window.y)}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(width * scale, window.x - margin),
                              height > 0.0F ? std::min(height * scale, window.y - margin) : 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20.0F * scale, 18.0F * scale});
    const bool shown = ImGui::BeginPopupModal(name, nullptr,
                                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                                  ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                                  ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    if (shown) {
        const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
        note((std::string("dialog ") + name).c_str(), at, {at.x + size.x, at.y + size.y});
    }
    return shown;
}

void end_dialog() { ImGui::EndPopup(); }

void heading(const char* text) {
    ImGui::PushFont(theme::title_font());
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

void rule() {
    const float scale = theme::scale();
    ImGui::Dummy({0.0F, 5.0F * scale});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y},
                                        ImGui::GetColorU32(theme::kLine));
    ImGui::Dummy({0.0F, 4.0F * scale});
}

void section(const char* title) {
    rule();
    ImGui::TextUnformatted(title);
    ImGui::Dummy({0.0F, 1.0F * theme::scale()});
}

bool button(const char* text, const ImVec2& size, const ImVec4& ground, const ImVec4& words) {
    ImGui::PushStyleColor(ImGuiCol_Button, ground);
    ImGui::PushStyleColor(ImGuiCol_Text, words);
    const bool pressed = ImGui::Button(text, size);
    ImGui::PopStyleColor(2);
    return pressed;
}

bool small_button(const char* text, const char* help) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {7.0F * theme::scale(), 2.0F * theme::scale()});
    const bool pressed = ImGui::Button(text);
    ImGui::PopStyleVar();
    tooltip(help);
    return pressed;
}

namespace {

// The title with a triangle that points down while the section is open.
void closing_title(const char* title, bool& closed) {
    const float height = ImGui::GetTextLineHeight(), half = 0.22F * height;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float up = at.y + ImGui::GetStyle().FramePadding.y;
    if (ImGui::InvisibleButton(title, {ImGui::CalcTextSize(title).x + height, ImGui::GetFrameHeight()}))
        closed = !closed;
    tooltip(closed ? ("Opens " + std::string(title)).c_str() : ("Closes " + std::string(title)).c_str());
    const ImU32 ink = ImGui::GetColorU32(ImGui::IsItemHovered() ? theme::kText : theme::kQuiet);
    const ImVec2 mark(at.x + half, up + 0.5F * height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (closed)
        list.AddTriangleFilled({mark.x - 0.7F * half, mark.y - half}, {mark.x - 0.7F * half, mark.y + half},
                               {mark.x + half, mark.y}, ink);
    else
        list.AddTriangleFilled({mark.x - half, mark.y - 0.7F * half}, {mark.x + half, mark.y - 0.7F * half},
                               {mark.x, mark.y + half}, ink);
    list.AddText({at.x + 0.85F * height, up}, ImGui::GetColorU32(theme::kText), title);
}

} // namespace

std::optional<TitleButton> title_row(const char* title, std::initializer_list<TitleButton> buttons, bool* closed) {
    rule();
    if (closed != nullptr) {
        closing_title(title, *closed);
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(title);
    }
    float width = 0.0F;
    const float padding = 14.0F * theme::scale(), gap = 4.0F * theme::scale();
    for (const TitleButton& button : buttons) width += ImGui::CalcTextSize(button.text).x + padding + gap;
    ImGui::SameLine();
    align_right(width - gap);
    std::optional<TitleButton> pressed;
    for (const TitleButton& button : buttons) {
        if (&button != buttons.begin()) ImGui::SameLine(0.0F, gap);
        if (small_button(button.text, button.help)) pressed = button;
    }
    return pressed;
}

void align_right(float width) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
}

void fact(const char* label, const std::string& value) {
    quiet(label);
    ImGui::SameLine();
    const std::string shown = fitted(value, ImGui::GetContentRegionAvail().x);
    text_right(shown);
    if (shown != value) tooltip(value.c_str());
}

bool fact_button(const char* label, const std::string& found, const ImVec4& colour, const char* help, const char* key) {
    const ImVec2 at = ImGui::GetCursorPos();
    ImGui::PushID(label);
    const bool pressed = ImGui::Selectable("##fact", false, 0, {0.0F, ImGui::GetTextLineHeight()});
    ImGui::PopID();
    tooltip(help, key);
    ImGui::SetCursorPos(at);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    fact(label, found);
    ImGui::PopStyleColor();
    return pressed;
}

void facts(const std::vector<Fact>& all) {
    const float gap = 18.0F * theme::scale();
    const float half = 0.5F * (ImGui::GetContentRegionAvail().x - gap);
    const auto is_short = [&](const Fact& one) {
        return ImGui::CalcTextSize(one.label).x + 0.5F * gap + ImGui::CalcTextSize(one.value.c_str()).x <= half;
    };
    const auto draw = [](const Fact& one) { one.draw ? one.draw() : fact(one.label, one.value); };
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool two = i + 1 < all.size() && is_short(all[i]) && is_short(all[i + 1]);
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.5F * gap, 0.0F});
        if (two && ImGui::BeginTable(all[i].label, 2, ImGuiTableFlags_SizingStretchSame)) {
            ImGui::TableNextColumn();
            draw(all[i]);
            ImGui::TableNextColumn();
            draw(all[++i]);
            ImGui::EndTable();
        } else {
            draw(all[i]);
        }
        ImGui::PopStyleVar();
    }
}

std::size_t list_row(const char* label, const char* help, float width, const std::vector<ListEntry>& entries,
                     std::size_t chosen) {
    ImGui::AlignTextToFramePadding();
    quiet(label);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width * theme::scale());
    ImGui::PushID(label);
    const bool open = ImGui::BeginCombo("##list", entries[chosen].label.c_str());
    if (!open) tooltip(help);
    if (open) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const auto flags = entries[i].possible ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
            if (ImGui::Selectable(entries[i].label.c_str(), i == chosen, flags)) chosen = i;
            note_item(entries[i].label.c_str());
            if (!entries[i].help.empty()) tooltip(entries[i].help.c_str());
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
    return chosen;
}

void text_right(const std::string& text) {
    align_right(ImGui::CalcTextSize(text.c_str()).x);
    ImGui::TextUnformatted(text.c_str());
}

std::string percent_text(float share) { return std::to_string(std::lround(100.0F * share)) + " %"; }

static void wrapped(const char* text, const ImVec4& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

void quiet(const char* text) { ImGui::TextColored(theme::kQuiet, "%s", text); }
void quiet_wrapped(const char* text) { wrapped(text, theme::kQuiet); }
void trouble(const char* text) { wrapped(text, theme::kTrouble); }

void patch(const ImVec2& at, const glm::vec3& colour) {
    const float size = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.15F * size}, {at.x + 0.7F * size, at.y + 0.85F * size},
                                              packed(glm::vec4(colour, 1.0F)), 2.0F);
}

void quiet_right(const std::string& text) {
    align_right(ImGui::CalcTextSize(text.c_str()).x);
    quiet(text.c_str());
}

namespace {

// Next to the item, towards the middle of the window, where it covers neither the item nor its neighbours.
void place_tooltip(TooltipAt at) {
    const ImVec2 least = ImGui::GetItemRectMin(), most = ImGui::GetItemRectMax(), window = ImGui::GetIO().DisplaySize;
    const float gap = 4.0F * theme::scale();
    const bool left = least.x + most.x > window.x, above = least.y + most.y > window.y;
    if (at == TooltipAt::kItem)
        ImGui::SetNextWindowPos({left ? most.x : least.x, above ? least.y - gap : most.y + gap}, ImGuiCond_Always,
                                {left ? 1.0F : 0.0F, above ? 1.0F : 0.0F});
    else
        ImGui::SetNextWindowPos({ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + gap, least.y - gap});
}

} // namespace

void tooltip(const char* text, const char* key, TooltipAt at) {
    note_item(text);
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    place_tooltip(at);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0F * theme::scale(), 7.0F * theme::scale()});
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0F); // also for disabled items
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320.0F * theme::scale());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    if (key != nullptr) {
        ImGui::SameLine(0.0F, 12.0F * theme::scale()); // independent of the local item spacing
        quiet(key);
    }
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
}

void column_heading(const char* text, const std::string& help, HeadingAt at, float arrow) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x - arrow;
    ImGui::PushID(text);
    ImGui::TableHeader("##heading");
    ImGui::PopID();
    tooltip(help.c_str());
    const std::string shown = fitted(text, room);
    const float before = at == HeadingAt::kRight ? room - ImGui::CalcTextSize(shown.c_str()).x : 0.0F;
    ImGui::GetWindowDrawList()->AddText({std::round(from.x + std::max(0.0F, before)), from.y},
                                        ImGui::GetColorU32(theme::kQuiet), shown.c_str());
}

void row_headings(const RowHeading& left, const RowHeading& right, float before_right) {
    ImGui::PushFont(theme::small_font());
    quiet(left.text);
    tooltip(left.help);
    ImGui::SameLine();
    align_right(ImGui::CalcTextSize(right.text).x + before_right);
    quiet(right.text);
    tooltip(right.help);
    ImGui::PopFont();
}

bool begin_list(const ListTable& table, std::size_t rows) {
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_ScrollY |
                                       ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_PadOuterX;
    ImGui::PushFont(theme::small_font());
    const float row_height = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
    const float wanted = static_cast<float>(std::min(rows, table.most_rows) + 1) * row_height + 2.0F * theme::scale();
    const float most = std::max(table.bottom - ImGui::GetCursorScreenPos().y, 3.0F * row_height);
    if (!ImGui::BeginTable(table.id, static_cast<int>(table.columns.size()), kFlags, {0.0F, std::min(wanted, most)})) {
        ImGui::PopFont();
        return false;
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const ListColumn& column : table.columns) ImGui::TableSetupColumn(column.heading, 0, column.share);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const ListColumn& column : table.columns)
        if (ImGui::TableNextColumn()) column_heading(column.heading, column.help);
    return true;
}

void end_list() {
    ImGui::EndTable();
    ImGui::PopFont();
}

std::string fitted(const std::string& text, float width) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    const auto starts_character = [&](std::size_t at) { return at >= text.size() || (text[at] & 0xC0) != 0x80; };
    for (std::size_t kept = text.size() - 1; kept > 2; --kept) {
        std::size_t head = kept / 2;
        std::size_t tail = text.size() - (kept - kept / 2);
        while (head > 0 && !starts_character(head)) --head;
        while (tail < text.size() && !starts_character(tail)) ++tail;
        std::string shorter = text.substr(0, head) + "\xE2\x80\xA6" + text.substr(tail);
        if (ImGui::CalcTextSize(shorter.c_str()).x <= width) return shorter;
    }
    std::size_t first = 1; // a whole character
    while (!starts_character(first)) ++first;
    return text.substr(0, first);
}

} // namespace ramus::app::widgets
