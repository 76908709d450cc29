// A slider of the side panel that changes the session once, when it is let go: every step would be a step of undo. What
// it says while it is held is there to be tried.
#pragma once

#include "app/panels/choice_row.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <imgui.h>

namespace ramus::app::widgets {

// What a slider remembers from frame to frame.
template <class T> struct Slider {
    T value{};
    bool held = false;
};

// One row: label, slider, value. `draw(T&)` draws the slider itself, `as_text(T)` is what stands at the right. True
// when it was let go at another value than `current`.
template <class T, class Draw, class AsText>
bool slider_row(const char* label, const char* help, Slider<T>& slider, T current, const Draw& draw,
                const AsText& as_text) {
    if (!slider.held) slider.value = current;
    begin_row(label, help, -40.0F * theme::scale());
    draw(slider.value);
    note_item(help);
    slider.held = ImGui::IsItemActive();
    const bool changed = ImGui::IsItemDeactivatedAfterEdit();
    ImGui::SameLine();
    text_right(as_text(slider.value));
    ImGui::PopID();
    return changed;
}

// A share of the whole, in percent.
inline bool share_row(const char* label, const char* help, Slider<float>& slider, double current, float most = 1.0F) {
    return slider_row(
        label, help, slider, static_cast<float>(current),
        [most](float& value) { ImGui::SliderFloat("##slider", &value, 0.0F, most, "", ImGuiSliderFlags_AlwaysClamp); },
        [](float value) { return percent_text(value); });
}

} // namespace ramus::app::widgets
