#include "core/slice/window.h"

#include <algorithm>
#include <vector>

namespace ramus::slice {

std::optional<Window> window_named(std::string_view preset) {
    for (const WindowPreset& known : kWindowPresets)
        if (known.name == preset) return known.window;
    return {};
}

Window usual_window(const volume::Volume& volume) {
    if (volume.window) return {volume.window->centre, volume.window->width};
    return automatic_window(volume);
}

Window automatic_window(const volume::Volume& volume) {
    constexpr std::size_t kVoxels = 200'000;
    const std::size_t count = volume::voxel_count(volume.size);
    // An odd step, so that rows of even length are not met at the same columns.
    const std::size_t step = std::max<std::size_t>(1, count / kVoxels) | 1U;
    const auto least = static_cast<float>(volume.minimum);
    std::vector<float> values;
    std::visit(
        [&](const auto& voxels) {
            for (std::size_t n = 0; n < count; n += step)
                if (const auto value = static_cast<float>(voxels[n]); value > least) values.push_back(value);
        },
        volume.voxels);
    if (values.empty()) return {least, 1.0};
    const auto at_share = [&](double share) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::ranges::nth_element(values, at);
        return static_cast<double>(*at);
    };
    const double black = at_share(0.01);
    const double white = at_share(0.99);
    return white > black ? Window{0.5 * (black + white), white - black} : Window{black, 1.0};
}

} // namespace ramus::slice
