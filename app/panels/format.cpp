#include "app/panels/format.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ramus::app {

std::string digits(double value, int significant) {
    if (value == 0.0 || !std::isfinite(value)) return value == 0.0 ? "0" : "?";
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
    if (std::abs(value) >= 999.5)
        return std::string(value < 0.0 ? "-" : "")
            .append(count(static_cast<std::uint64_t>(std::llround(std::abs(value)))));
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", std::clamp(significant - 1 - magnitude, 0, 9), value);
    return text;
}

std::string count(std::uint64_t value) {
    const std::string ungrouped = std::to_string(value);
    std::string text;
    for (std::size_t i = 0; i < ungrouped.size(); ++i) {
        if (i > 0 && (ungrouped.size() - i) % 3 == 0) text.push_back(',');
        text.push_back(ungrouped[i]);
    }
    return text;
}

std::string seconds_text(double seconds) {
    return seconds < 0.9995 ? digits(1000.0 * seconds, 2) + " ms" : digits(seconds) + " s";
}

} // namespace ramus::app
