// Text stands out from what it stands on, in both themes.
#include "app/panels/theme.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <utility>

using namespace ramus::app;

namespace {

// Relative luminance of sRGB and the contrast of two colours (WCAG 2.1, definitions).
double linear(float channel) {
    return channel <= 0.03928F ? channel / 12.92 : std::pow((static_cast<double>(channel) + 0.055) / 1.055, 2.4);
}
double luminance(const ImVec4& c) { return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z); }
double contrast(const ImVec4& a, const ImVec4& b) {
    const double la = luminance(a), lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}
ImVec4 over(const ImVec4& veil, const ImVec4& ground) {
    const auto mix = [&](float a, float b) { return a * veil.w + b * (1.0F - veil.w); };
    return {mix(veil.x, ground.x), mix(veil.y, ground.y), mix(veil.z, ground.z), 1.0F};
}

} // namespace

TEST_CASE("contrast is as the definition has it") {
    CHECK(contrast({0, 0, 0, 1}, {1, 1, 1, 1}) == doctest::Approx(21.0));
    CHECK(contrast({0.5F, 0.5F, 0.5F, 1}, {0.5F, 0.5F, 0.5F, 1}) == doctest::Approx(1.0));
}

TEST_CASE("text of both themes has a contrast of 4.5 : 1 on every ground it stands on") {
    constexpr double kLeast = 4.5; // WCAG 2.1, success criterion 1.4.3
    for (const theme::Kind kind : {theme::Kind::kDark, theme::Kind::kLight}) {
        CAPTURE(static_cast<int>(kind));
        const theme::Palette& p = theme::palette(kind);
        const std::array plain{std::pair{"panel", p.panel},
                               std::pair{"bar", p.bar},
                               std::pair{"popup", p.popup},
                               std::pair{"button", p.button},
                               std::pair{"raised", over(p.raised, p.panel)},
                               std::pair{"raised on the bar", over(p.raised, p.bar)}};
        const std::array pressed{std::pair{"frame", p.frame},
                                 std::pair{"hovered frame", p.frame_hovered},
                                 std::pair{"active frame", p.frame_active},
                                 std::pair{"hovered button", p.button_hovered},
                                 std::pair{"hovered entry", p.entry_hovered},
                                 std::pair{"chosen", p.accent_dim},
                                 std::pair{"losing", p.trouble_dim}};
        for (const auto& one : plain) {
            CAPTURE(one.first);
            for (const ImVec4& words :
                 {p.text, p.quiet, p.disabled, p.accent, p.highlight, p.trouble, p.good, p.suspect, p.overlap, p.gap})
                CHECK(contrast(words, one.second) >= kLeast);
        }
        for (const auto& one : pressed) {
            CAPTURE(one.first);
            CHECK(contrast(p.text, one.second) >= kLeast);
        }
        // Marks of the status bar are pressed in these colours.
        for (const ImVec4& words : {p.accent, p.highlight}) CHECK(contrast(words, p.button_hovered) >= kLeast);
    }
}
