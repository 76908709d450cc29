// The curves of a file of markups (slicer.h), taken as they are read, so that memory holds their numbers and never a
// value of JSON for each control point. Internal to the reader.
#pragma once

#include "core/io/json_text.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct MarkupsMeasurement {
    std::string name;
    std::vector<double> values; // by control point; kUnknownValue: no number
};

struct MarkupsCurve {
    std::size_t number = 0; // among all markups
    bool closed = false;
    bool has_points = false;         // the list is there
    std::string unit;                // as written; empty: it does not say
    std::optional<std::string> axes; // as written; none: it does not say
    // None: without a place, which the file says itself.
    std::vector<std::optional<glm::dvec3>> points;
    std::optional<std::size_t> bad_point; // the first whose position is none
    std::vector<MarkupsMeasurement> measurements;
};

// What this program writes next to the curves; lists of what is no index have kNoJsonIndex.
struct MarkupsOwn {
    std::vector<std::uint32_t> roots, systems_of_curves;
    std::vector<std::int64_t> points; // of the curves, one curve behind the other
    std::vector<std::size_t> ends;    // by curve: behind its last
    std::vector<int> labels;
    bool good = true; // as this program writes it
};

class MarkupsLists {
public:
    std::vector<MarkupsCurve> curves;
    std::size_t markups = 0, others = 0; // of all kinds; those that are no curves
    MarkupsOwn own;

    // For parsed_json().
    [[nodiscard]] JsonElements taker_of(JsonPath list);

private:
    void take_point(const nlohmann::json& point);
    void take_measurement(const nlohmann::json& measurement);
    void take_markup(const nlohmann::json& markup);
    JsonElements own_taker(JsonPath list);

    MarkupsCurve curve_; // that is read
    std::vector<double> values_;
};

} // namespace ramus::io
