#include "app/session/deviation.h"

#include "app/session/comparison.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace ramus::app {

std::string_view name_of(DeviationChoice::Unit unit) { return unit == DeviationChoice::Unit::kMm ? "mm" : "voxels"; }

std::optional<DeviationChoice::Unit> deviation_unit_named(std::string_view name) {
    const auto* found =
        std::ranges::find(kDeviationUnits, name, [](DeviationChoice::Unit unit) { return name_of(unit); });
    return found == kDeviationUnits.end() ? std::nullopt : std::optional(*found);
}

std::string noun_of(const DeviationChoice& choice, const Comparison& comparison) {
    if (choice.from == DeviationChoice::From::kFile) return std::filesystem::path(choice.file).filename().string();
    std::string noun = title_of(
        choice.from == DeviationChoice::From::kCones ? Compared::kTruncatedCones : Compared::kIsosurface, comparison);
    noun.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(noun.front())));
    return noun;
}

} // namespace ramus::app
