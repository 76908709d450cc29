// Window: which values of a scan a picture shows, from black to white. The level is the value in the middle, in the
// scan's own units (Hounsfield units in CT).
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace ramus::slice {

struct Window {
    double level = 40.0, width = 400.0; // the width is positive
    // From 0 (black) to 1 (white); NaN stays.
    [[nodiscard]] double grey(double value) const {
        return std::clamp((value - (level - 0.5 * width)) / width, 0.0, 1.0);
    }
    bool operator==(const Window&) const = default;
};

// Usual windows of CT.
inline constexpr std::array<std::pair<std::string_view, Window>, 5> kWindows{{{"abdomen", {40.0, 400.0}},
                                                                              {"liver", {70.0, 150.0}},
                                                                              {"lung", {-600.0, 1500.0}},
                                                                              {"bone", {400.0, 2000.0}},
                                                                              {"angiography", {200.0, 600.0}}}};
[[nodiscard]] std::optional<Window> window_named(std::string_view name);

// From the 1st to the 99th percentile of values; NaN do not count. The default without values.
[[nodiscard]] Window window_of(std::span<const float> values);

} // namespace ramus::slice
