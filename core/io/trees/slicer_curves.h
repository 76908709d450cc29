// Consumes the curves of a markups file (slicer.h) while it is parsed, so memory holds their numbers and no JSON value
// for each control point. Internal to the reader.
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
    bool has_points = false;         // the list of control points exists
    std::string unit;                // as written; empty: not stated
    std::optional<std::string> axes; // as written; none: not stated
    // None: the file says that the control point has no position.
    std::vector<std::optional<glm::dvec3>> points;
    std::optional<std::size_t> bad_point; // the first with an invalid position
    std::vector<MarkupsMeasurement> measurements;
};

// The member "ramus", which ramus writes in addition to the curves. Invalid indices are kNoJsonIndex.
struct MarkupsOwn {
    std::vector<std::uint32_t> roots, systems_of_curves;
    std::vector<std::int64_t> points; // indices in the tree of the control points, curve by curve
    std::vector<std::size_t> ends;    // by curve: one past its last element of `points`
    std::vector<int> labels;
    bool good = true; // has the structure that ramus writes
};

class MarkupsLists {
public:
    std::vector<MarkupsCurve> curves;
    std::size_t markups = 0, others = 0; // number of markups of all kinds, and of those that are not curves
    MarkupsOwn own;

    // The `lists` argument of parsed_json().
    [[nodiscard]] JsonElements taker_of(JsonPath list);

private:
    void take_point(const nlohmann::json& point);
    void take_measurement(const nlohmann::json& measurement);
    void take_markup(const nlohmann::json& markup);
    JsonElements own_taker(JsonPath list);

    MarkupsCurve curve_; // the current one
    std::vector<double> values_;
};

} // namespace ramus::io
