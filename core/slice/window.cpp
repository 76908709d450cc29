#include "core/slice/window.h"

#include "core/base/words.h"

#include <cmath>
#include <vector>

namespace ramus::slice {

std::optional<Window> window_named(std::string_view name) { return paired(kWindows, name); }

Window window_of(std::span<const float> values) {
    std::vector<float> known;
    std::ranges::copy_if(values, std::back_inserter(known), [](float value) { return !std::isnan(value); });
    if (known.empty()) return {};
    const auto percentile = [&](double share) {
        const auto at = known.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(known.size() - 1));
        std::ranges::nth_element(known, at);
        return static_cast<double>(*at);
    };
    const double low = percentile(0.01), high = percentile(0.99);
    return {0.5 * (low + high), high > low ? high - low : 1.0};
}

} // namespace ramus::slice
