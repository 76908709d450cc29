#include "app/commands/printed_report.h"

#include "core/io/json_text.h"

#include <array>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

// The name without its unit; empty: the name has no unit.
std::string without_unit(std::string_view name) {
    constexpr std::array<std::string_view, 3> kUnits{"_mm", "_mm2", "_mm3"};
    for (const std::string_view unit : kUnits)
        if (name.size() > unit.size() && name.ends_with(unit))
            return std::string(name.substr(0, name.size() - unit.size()));
    return {};
}

ordered_json with_plain_names(ordered_json value, bool& has_lengths) {
    if (value.is_array())
        for (ordered_json& one : value) one = with_plain_names(std::move(one), has_lengths);
    if (!value.is_object()) return value;
    ordered_json object = ordered_json::object();
    for (auto& [name, member] : value.items()) {
        const std::string plain = name == "units" && !member.is_number() ? "unit" : without_unit(name);
        ordered_json changed = with_plain_names(std::move(member), has_lengths);
        const bool twice = !plain.empty() && !value.contains(plain);
        if (twice) has_lengths = true;
        if (twice) object[name] = changed;
        object[twice ? plain : name] = std::move(changed);
    }
    return object;
}

} // namespace

std::string printed_report(ordered_json report, const tree::Claims& claims) {
    bool has_lengths = false;
    report = with_plain_names(std::move(report), has_lengths);
    if (has_lengths && !report.contains("unit")) report["unit"] = claims.unit_word();
    return io::printed_json(report);
}

} // namespace ramus::app
