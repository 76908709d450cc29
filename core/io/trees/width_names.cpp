#include "core/io/trees/width_names.h"

#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::io {

std::optional<WidthName> width_by_word(std::string_view name) {
    const std::string lower = lower_case(name);
    for (const WidthName& known : kWidthNames)
        if (lower == known.name) return known;
    if (lower.find("diam") != std::string::npos) return WidthName{name, RadiusIs::kDiameter, true};
    if (lower.find("radius") != std::string::npos || lower.find("radii") != std::string::npos)
        return WidthName{name, RadiusIs::kRadius, true};
    return std::nullopt;
}

std::optional<ChosenWidth> choose_width(const std::vector<std::string>& names, const ReadOptions& options) {
    const auto chosen = [&](auto at, const WidthName& width) {
        return ChosenWidth{static_cast<std::size_t>(at - names.begin()), width.is, width.open};
    };
    if (const auto asked = options.columns.find("radius"); asked != options.columns.end()) {
        const auto at = std::ranges::find(names, asked->second);
        if (at == names.end()) return std::nullopt;
        return chosen(at, width_by_word(*at).value_or(WidthName{*at, RadiusIs::kRadius, true}));
    }
    for (const WidthName& known : kWidthNames)
        for (auto at = names.begin(); at != names.end(); ++at)
            if (lower_case(*at) == known.name) return chosen(at, known);
    for (auto at = names.begin(); at != names.end(); ++at)
        if (const auto width = width_by_word(*at)) return chosen(at, *width);
    return std::nullopt;
}

} // namespace ramus::io
