#include "core/io/length_unit.h"

#include "core/io/text_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

namespace ramus::io {

namespace {

// The usual name of each size first.
constexpr std::pair<std::string_view, double> kUnits[] = {
    {"mm", 1.0},           {"millimetre", 1.0}, {"millimetres", 1.0}, {"millimeter", 1.0},   {"millimeters", 1.0},
    {"um", 1e-3},          {"\xC2\xB5m", 1e-3}, // micro sign
    {"\xCE\xBCm", 1e-3},                        // Greek mu
    {"micron", 1e-3},      {"microns", 1e-3},   {"micrometre", 1e-3}, {"micrometres", 1e-3}, {"micrometer", 1e-3},
    {"micrometers", 1e-3}, {"cm", 10.0},        {"centimetre", 10.0}, {"centimetres", 10.0}, {"centimeter", 10.0},
    {"centimeters", 10.0}, {"m", 1e3},          {"metre", 1e3},       {"metres", 1e3},       {"meter", 1e3},
    {"meters", 1e3},       {"nm", 1e-6},        {"nanometre", 1e-6},  {"nanometres", 1e-6},  {"nanometer", 1e-6},
    {"nanometers", 1e-6},  {"angstrom", 1e-7},  {"in", 25.4},         {"inch", 25.4}};

} // namespace

std::optional<double> named_unit_mm(std::string_view name) {
    const std::string word = lower_case(name);
    const auto* const known =
        std::ranges::find(kUnits, std::string_view(word), [](const auto& unit) { return unit.first; });
    return known == std::end(kUnits) ? std::nullopt : std::optional(known->second);
}

std::optional<LengthUnit> length_unit(std::string_view text) {
    if (const auto mm = named_unit_mm(text)) return LengthUnit{glm::dvec3(*mm)};
    if (text.ends_with("mm")) text.remove_suffix(2);
    glm::dvec3 sizes(0.0);
    int count = 0;
    while (count < 3) {
        const std::size_t end = std::min(text.find('x'), text.size());
        const auto [stop, error] = std::from_chars(text.data(), text.data() + end, sizes[count]);
        if (error != std::errc() || stop != text.data() + end || !(sizes[count] > 0.0) || !std::isfinite(sizes[count]))
            return std::nullopt;
        ++count;
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
        if (count == 3) return std::nullopt;
    }
    if (count == 1) sizes = glm::dvec3(sizes.x);
    return count == 2 ? std::nullopt : std::optional(LengthUnit{sizes});
}

std::string name_of(const LengthUnit& unit) {
    for (const auto& [name, mm] : kUnits)
        if (unit.mm == glm::dvec3(mm)) return std::string(name);
    if (unit.mm == glm::dvec3(unit.mm.x)) return short_number(unit.mm.x) + " mm";
    return short_number(unit.mm.x) + " x " + short_number(unit.mm.y) + " x " + short_number(unit.mm.z) + " mm";
}

} // namespace ramus::io
