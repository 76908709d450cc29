#include "core/io/trees/slicer_curves.h"

#include "core/io/trees/json_input.h"
#include "core/tree/vessel_tree.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace ramus::io {

namespace {

using nlohmann::json;

// The code of a unit: a text, or the first element of a list such as ["mm", "UCUM", "millimeter"].
std::string mrk_unit(const json& object, const char* key) {
    const json* list = json_list(object, key);
    if (list != nullptr && !list->empty() && list->front().is_string()) return list->front().get<std::string>();
    return json_text(object, key);
}

// Whether the path of a list consists of these keys; "" is any element of a list.
bool leads(JsonPath list, std::initializer_list<std::string_view> keys) {
    return std::equal(list.begin(), list.end(), keys.begin(), keys.end());
}

} // namespace

void MarkupsLists::take_point(const json& point) {
    if (curve_.bad_point) return; // the file is refused
    const std::string status = json_text(point, "positionStatus");
    if (!status.empty() && status != "defined") {
        curve_.points.emplace_back();
        return;
    }
    const auto position = json_position(json_member(point, "position"));
    if (!position) curve_.bad_point = curve_.points.size();
    curve_.points.push_back(position);
}

void MarkupsLists::take_measurement(const json& measurement) {
    if (json_list(measurement, "controlPointValues") != nullptr)
        curve_.measurements.push_back({json_text(measurement, "name"), std::move(values_)});
    values_ = {};
}

void MarkupsLists::take_markup(const json& markup) {
    MarkupsCurve curve = std::exchange(curve_, {});
    curve.number = markups++;
    const std::string type = json_text(markup, "type");
    if (type != "Curve" && type != "ClosedCurve" && type != "Line") {
        ++others;
        return;
    }
    curve.closed = type == "ClosedCurve";
    curve.has_points = json_list(markup, "controlPoints") != nullptr;
    curve.unit = mrk_unit(markup, "coordinateUnits");
    if (const json* axes = json_member(markup, "coordinateSystem"))
        curve.axes = axes->is_string() ? axes->get<std::string>() : axes->dump();
    curves.push_back(std::move(curve));
}

JsonElements MarkupsLists::own_taker(JsonPath list) {
    if (leads(list, {"ramus", "roots"})) return [this](const json& value) { own.roots.push_back(json_index(value)); };
    if (leads(list, {"ramus", "curve_systems"}))
        return [this](const json& value) { own.systems_of_curves.push_back(json_index(value)); };
    if (leads(list, {"ramus", "labels"}))
        return [this](const json& value) {
            own.good &= value.is_number_integer();
            own.labels.push_back(value.is_number_integer() ? static_cast<int>(value.get<std::int64_t>()) : 0);
        };
    if (leads(list, {"ramus", "curves"}))
        return [this](const json& row) {
            own.good &= row.is_array();
            own.ends.push_back(own.points.size());
        };
    if (leads(list, {"ramus", "curves", ""}))
        return [this](const json& value) { own.points.push_back(json_index(value)); };
    return {}; // systems
}

JsonElements MarkupsLists::taker_of(JsonPath list) {
    if (list.empty()) return {};
    if (list.front() == "ramus") return own_taker(list);
    if (leads(list, {"markups"})) {
        curves.clear(), markups = 0, others = 0;
        return [this](const json& markup) { take_markup(markup); };
    }
    if (leads(list, {"markups", "", "controlPoints"})) {
        curve_.points.clear(), curve_.bad_point.reset();
        return [this](const json& point) { take_point(point); };
    }
    if (leads(list, {"markups", "", "controlPoints", "", "position"})) return {};
    if (leads(list, {"markups", "", "coordinateUnits"})) return {};
    if (leads(list, {"markups", "", "measurements"})) {
        curve_.measurements.clear();
        return [this](const json& measurement) { take_measurement(measurement); };
    }
    if (leads(list, {"markups", "", "measurements", "", "controlPointValues"})) {
        values_.clear();
        return [this](const json& value) { values_.push_back(json_real(&value).value_or(tree::kUnknownValue)); };
    }
    return [](json& /*value*/) {}; // display properties in 3D Slicer
}

} // namespace ramus::io
