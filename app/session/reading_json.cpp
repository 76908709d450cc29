#include "app/session/reading_json.h"

#include "app/session/json_values.h"
#include "app/session/marks_json.h"
#include "app/session/mask_reading.h"
#include "app/session/reading_options.h"

#include <cmath>

namespace ramus::app::session_json {

namespace {

void read_mask(const json& value, io::MaskReading& mask) {
    constexpr double kMost = 1e9;
    if (value.contains("fill_holes")) mask.fill_holes = truth(value["fill_holes"], "fill_holes");
    if (value.contains("isovalue")) mask.isovalue = number(value["isovalue"], "isovalue", -HUGE_VAL, HUGE_VAL);
    if (value.contains("bulge_size")) mask.bulge_size = number(value["bulge_size"], "bulge_size", 0.0, kMost);
    if (value.contains("islands")) mask.islands_mm = number(value["islands"], "islands", 0.0, kMost);
    if (!value.contains("root")) return;
    const json& root = value["root"];
    if (!root.is_array() || root.size() != 3) throw Refusal{"root is not [x, y, z]"};
    mask.root.emplace();
    for (int axis = 0; axis < 3; ++axis)
        (*mask.root)[axis] = number(root[static_cast<std::size_t>(axis)], "coordinate of root", -kMost, kMost);
}

} // namespace

void write_part(const io::VolumePart& part, json& value) {
    if (part.channel) value["channel"] = *part.channel;
    if (part.time) value["time"] = *part.time;
}

io::VolumePart part_in(const json& value) {
    io::VolumePart part;
    constexpr int kMost = 1'000'000'000;
    if (value.contains("channel")) part.channel = integer(value["channel"], "channel", 1, kMost);
    if (value.contains("time")) part.time = integer(value["time"], "time", 1, kMost);
    return part;
}

json reading_json(const io::ReadOptions& reading, const std::filesystem::path& folder) {
    json value = json::object();
    if (reading.unit) value["units"] = spelled(*reading.unit);
    if (reading.radius_is) value["radius_is"] = spelled(*reading.radius_is);
    if (reading.radius_mm) value["radius_mm"] = *reading.radius_mm;
    write_part(reading.part, value);
    if (reading.orientation) value["orientation"] = reading.orientation->letters();
    if (reading.repair != tree::Repair::kUsual) value["repair"] = spelled(reading.repair);
    if (!reading.columns.empty()) value["columns"] = reading.columns;
    if (!reading.data.empty()) {
        value["data"] = written_path(reading.data, folder).string();
        value["data_checksum"] = reading.data_checksum;
    }
    const io::MaskReading& mask = reading.mask;
    if (mask.labels) value["labels"] = spelled(*mask.labels);
    if (mask.isovalue) value["isovalue"] = *mask.isovalue;
    if (mask.fill_holes) value["fill_holes"] = *mask.fill_holes;
    if (mask.bulge_size) value["bulge_size"] = *mask.bulge_size;
    if (mask.islands_mm) value["islands"] = *mask.islands_mm;
    if (mask.root) value["root"] = {mask.root->x, mask.root->y, mask.root->z};
    return value;
}

io::ReadOptions reading_in(const json& value, const std::filesystem::path& folder) {
    expect_only(value, "reading",
                {"units", "radius_is", "radius_mm", "orientation", "axes", "repair", "columns", "labels", "isovalue",
                 "fill_holes", "bulge_size", "islands", "root", "data", "data_checksum", "channel", "time"});
    io::ReadOptions reading;
    for (const auto& [name, key] :
         {std::pair("units", "units"), std::pair("radius_is", "radius-is"), std::pair("axes", "axes"),
          std::pair("orientation", "orientation"), std::pair("repair", "repair"), std::pair("labels", "labels")}) {
        if (!value.contains(name)) continue;
        auto next = with(std::move(reading), key, text(value[name], name));
        if (!next) throw Refusal{std::string(name) + ": " + next.error().message()};
        reading = std::move(*next);
    }
    if (value.contains("columns")) {
        if (!value["columns"].is_object()) throw Refusal{"columns is not an object"};
        for (const auto& [what, name] : value["columns"].items()) reading.columns[what] = text(name, "column " + what);
    }
    if (value.contains("data")) reading.data = (folder / text(value["data"], "data")).lexically_normal().string();
    if (value.contains("data_checksum")) reading.data_checksum = text(value["data_checksum"], "data_checksum");
    if (value.contains("radius_mm"))
        reading.radius_mm = number(value["radius_mm"], "radius_mm", kLeastRadius, tree::kMaximumRadius);
    reading.part = part_in(value);
    read_mask(value, reading.mask);
    return reading;
}

} // namespace ramus::app::session_json
