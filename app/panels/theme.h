// Theme of the interface: dark and light colours for ImGui, and fonts. Sizes are in points (1/96 inch); `scale` is
// pixels per point. The font is Open Sans from Debian's fonts-open-sans, otherwise ImGui's own.
#pragma once

#include <imgui.h>

namespace ramus::app::theme {

inline constexpr float kTextSize = 15.0F; // points
inline constexpr float kSmallSize = 13.0F;
inline constexpr float kTitleSize = 20.0F;

// The colours of a theme. Text has a contrast of at least 4.5 : 1 on each of its backgrounds (WCAG 2.1, success
// criterion 1.4.3); a test checks that.
struct Palette {
    ImVec4 text;
    ImVec4 quiet;      // labels, units, hints
    ImVec4 disabled;   // unavailable items
    ImVec4 accent;     // the picture's selection colour, for text
    ImVec4 accent_dim; // background of chosen items
    ImVec4 highlight, trouble, good;
    ImVec4 suspect, overlap, gap; // the colours of these marks in the picture, for text
    ImVec4 trouble_dim;           // background of destructive buttons
    ImVec4 panel, bar, popup;
    ImVec4 line;
    ImVec4 frame, frame_hovered, frame_active;    // fields
    ImVec4 button, button_hovered, entry_hovered; // buttons; entries of lists and menus
    ImVec4 grab, grab_hovered, grab_active;       // of scroll bars
    ImVec4 slider;                                // the knob of a slider
    ImVec4 raised;                                // over any background: clickable items, every other row
};
enum class Kind { kDark, kLight };
[[nodiscard]] const Palette& palette(Kind kind);

// The current colours; they are constant within a frame.
inline Palette palette_in_use;
// NOLINTBEGIN(readability-identifier-naming)
inline const ImVec4& kText = palette_in_use.text;
inline const ImVec4& kQuiet = palette_in_use.quiet;
inline const ImVec4& kAccent = palette_in_use.accent;
inline const ImVec4& kAccentDim = palette_in_use.accent_dim;
inline const ImVec4& kHighlight = palette_in_use.highlight;
inline const ImVec4& kTrouble = palette_in_use.trouble;
inline const ImVec4& kGood = palette_in_use.good;
inline const ImVec4& kSuspect = palette_in_use.suspect;
inline const ImVec4& kOverlap = palette_in_use.overlap;
inline const ImVec4& kGap = palette_in_use.gap;
inline const ImVec4& kTroubleDim = palette_in_use.trouble_dim;
inline const ImVec4& kPanel = palette_in_use.panel;
inline const ImVec4& kBar = palette_in_use.bar;
inline const ImVec4& kFrame = palette_in_use.frame;
inline const ImVec4& kLine = palette_in_use.line;
inline const ImVec4& kRaised = palette_in_use.raised;
// NOLINTEND(readability-identifier-naming)
inline const ImVec4 kNothing{0.00F, 0.00F, 0.00F, 0.00F}; // background of a button without one
// For text on the picture, which is dark in both themes.
inline const ImVec4 kOnPicture{0.87F, 0.88F, 0.90F, 1.00F};
inline const ImVec4 kQuietOnPicture{0.60F, 0.63F, 0.68F, 1.00F};

// Switches the theme from the next frame on.
void use(Kind kind);

// Sets colours and sizes of the current ImGui context and loads its fonts, which must then be uploaded. Dark until
// use().
void apply(float scale);

// Null: use ImGui's font.
[[nodiscard]] ImFont* small_font();
[[nodiscard]] ImFont* title_font();
[[nodiscard]] float scale();

} // namespace ramus::app::theme
