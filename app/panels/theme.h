// The look of the interface: a dark, quiet theme for ImGui, and its fonts. Sizes are in points (1/96 inch); `scale` is
// pixels per point. Text is Open Sans from Debian's fonts-open-sans; where that is missing, ImGui's own.
#pragma once

#include <imgui.h>

namespace ramus::app::theme {

inline constexpr float kTextSize = 15.0F; // points
inline constexpr float kSmallSize = 13.0F;
inline constexpr float kTitleSize = 20.0F;

inline const ImVec4 kText{0.87F, 0.88F, 0.90F, 1.00F};
inline const ImVec4 kQuiet{0.56F, 0.59F, 0.64F, 1.00F};  // labels, units, hints
inline const ImVec4 kAccent{0.36F, 0.80F, 1.00F, 1.00F}; // the colour of selection in the picture
inline const ImVec4 kAccentDim{0.20F, 0.42F, 0.54F, 1.00F};
inline const ImVec4 kHighlight{1.00F, 0.74F, 0.20F, 1.00F};
inline const ImVec4 kTrouble{1.00F, 0.48F, 0.40F, 1.00F};
inline const ImVec4 kTroubleDim{0.52F, 0.25F, 0.21F, 1.00F};
inline const ImVec4 kPanel{0.098F, 0.106F, 0.122F, 1.00F};
inline const ImVec4 kBar{0.082F, 0.090F, 0.104F, 1.00F};
inline const ImVec4 kLine{0.18F, 0.195F, 0.22F, 1.00F};
inline const ImVec4 kNothing{0.00F, 0.00F, 0.00F, 0.00F}; // the ground of a button without one

// Sets colours and sizes of the current ImGui context and loads its fonts; upload them afterwards.
void apply(float scale);

// Null: ImGui's own in every size.
[[nodiscard]] ImFont* small_font();
[[nodiscard]] ImFont* title_font();
[[nodiscard]] float scale();

} // namespace ramus::app::theme
