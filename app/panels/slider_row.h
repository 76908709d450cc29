// A slider row of the side panel. The session changes only when the slider is released, as one step of undo; while it
// is held, its value is a trial value.
#pragma once

#include "app/panels/choice_row.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <imgui.h>

namespace ramus::app::widgets {

// State of a slider between frames.
template <class T> struct Slider {
    T value{};
    bool held = false;
};

// A row with label, slider and value. `draw(T&)` draws the slider; `as_text(T)` formats the value. True if it was
// released at another value than `current`.
template <class T, class Draw, class AsText>
bool slider_row(const char* label, const char* help, Slider<T>& slider, T current, const Draw& draw,
                const AsText& as_text) {
    if (!slider.held) slider.value = current;
    constexpr float kValue = 56.0F; // "0.25 mm" fits
    begin_row(label, help, -kValue * theme::scale());
    draw(slider.value);
    note_item(help);
    slider.held = ImGui::IsItemActive();
    const bool changed = ImGui::IsItemDeactivatedAfterEdit();
    ImGui::SameLine();
    text_right(as_text(slider.value));
    ImGui::PopID();
    return changed;
}

// A slider for a fraction, shown in percent.
inline bool share_row(const char* label, const char* help, Slider<float>& slider, double current, float most = 1.0F) {
    return slider_row(
        label, help, slider, static_cast<float>(current),
        [most](float& value) { ImGui::SliderFloat("##slider", &value, 0.0F, most, "", ImGuiSliderFlags_AlwaysClamp); },
        [](float value) { return percent_text(value); });
}

} // namespace ramus::app::widgets
