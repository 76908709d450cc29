// Window: which values of a scan are shown from black to white (window and level).
#pragma once

#include "core/volume/volume.h"

#include <array>
#include <optional>
#include <string_view>

namespace ramus::slice {

struct Window {
    double level = 0.0, width = 1.0; // the value in the middle, and white minus black; the width is positive

    [[nodiscard]] double black() const { return level - 0.5 * width; }
    // 0 at and below black, 1 at and above white.
    [[nodiscard]] float grey(float value) const {
        const float share = (value - static_cast<float>(black())) / static_cast<float>(width);
        return share < 0.0F ? 0.0F : share > 1.0F ? 1.0F : share;
    }
    bool operator==(const Window&) const = default;
};

// The customary windows of CT, in HU.
struct WindowPreset {
    std::string_view name;
    Window window;
};
inline constexpr std::array<WindowPreset, 5> kWindowPresets{{{"abdomen", {40.0, 400.0}},
                                                             {"liver", {70.0, 150.0}},
                                                             {"lung", {-600.0, 1500.0}},
                                                             {"bone", {400.0, 2000.0}},
                                                             {"angiography", {200.0, 600.0}}}};
[[nodiscard]] std::optional<Window> window_named(std::string_view preset);

// The window that the file proposes, otherwise automatic_window().
[[nodiscard]] Window usual_window(const volume::Volume& volume);

// From the value that 1 % of the voxels are below to the value that 1 % are above, without voxels of the least value,
// which are mostly outside of the patient. Of every nth voxel, so that it takes a few milliseconds.
[[nodiscard]] Window automatic_window(const volume::Volume& volume);

} // namespace ramus::slice
