#include "app/session/thickness_text.h"

#include "app/session/numbers.h"

#include <algorithm>

namespace ramus::app {

using measure::Thickness;

std::string place_text(const Thickness& thickness) {
    const glm::vec3& p = thickness.at;
    const std::string at = "at (" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ")";
    return thickness.branch == tree::kNoBranch ? at : "branch " + std::to_string(thickness.branch) + " " + at;
}

std::string printing_text(std::span<const Thickness> thicknesses, const Lengths& lengths) {
    std::string text = lengths.known() ? "closed, in mm" : "closed; nobody has said what its unit is";
    if (!thicknesses.empty())
        text += "; thinnest place " + lengths.text(thicknesses.front().mm) + ", " + place_text(thicknesses.front());
    return text;
}

std::span<const Thickness> thinner_than(std::span<const Thickness> thicknesses, double least_mm) {
    const auto end = std::ranges::lower_bound(thicknesses, least_mm, {}, &Thickness::mm);
    return thicknesses.first(static_cast<std::size_t>(end - thicknesses.begin()));
}

std::string thin_text(std::span<const Thickness> thicknesses, double least_mm, const Lengths& lengths) {
    const auto thin = thinner_than(thicknesses, least_mm);
    if (thin.empty()) return {};
    return (thin.front().branch == tree::kNoBranch ? std::string("there are places")
                                                   : counted(thin.size(), "branch is", "branches are")) +
           " thinner than " + lengths.text(least_mm) + (lengths.known() ? "" : " (which printers take for mm)") +
           ", the thinnest with " + lengths.text(thin.front().mm) + " (" + place_text(thin.front()) +
           "): they may break or not be printed";
}

} // namespace ramus::app
