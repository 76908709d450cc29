#include "app/session/mask_reading.h"

#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ramus::app {

namespace {

constexpr std::array<std::string_view, 6> kKeys{"labels", "isovalue", "fill-holes", "bulge-size", "islands", "root"};

std::optional<double> number_in(std::string_view text, double least) {
    const auto value = parsed<double>(text);
    return value && std::isfinite(*value) && *value >= least ? value : std::nullopt;
}

std::optional<glm::dvec3> place_in(std::string_view text) {
    const std::vector<std::string_view> parts = parts_of(text);
    glm::dvec3 place(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = parts.size() == 3 ? number_in(parts[std::size_t(axis)], -HUGE_VAL) : std::nullopt;
        if (!value) return std::nullopt;
        place[axis] = *value;
    }
    return place;
}

} // namespace

bool is_mask_option(std::string_view key) { return std::ranges::find(kKeys, key) != kKeys.end(); }

Result<io::MaskReading> with(io::MaskReading mask, std::string_view key, const std::string& value) {
    const bool reset = value == "auto";
    const auto refused = [&](const std::string& hint) { return fail("\"" + value + "\" is not known", {}, hint); };
    if (key == "labels") {
        mask.labels.reset();
        if (value == "together")
            mask.labels.emplace();
        else if (!reset && value != "apart" && !(mask.labels = label_groups(value)))
            return refused("labels takes apart, together, those of each system as 1+3,2, or auto");
    } else if (key == "isovalue") {
        mask.isovalue = number_in(value, -HUGE_VAL);
        if (!mask.isovalue && !reset) return refused("isovalue takes a number, or auto");
    } else if (key == "fill-holes") {
        mask.fill_holes = reset ? std::nullopt : std::optional(value == "on");
        if (!reset && value != "on" && value != "off") return refused("fill-holes takes on, off or auto");
    } else if (key == "bulge-size") {
        mask.bulge_size = number_in(value, 0.0);
        if (!mask.bulge_size && !reset) return refused("bulge-size takes a number that is not negative, or auto");
    } else if (key == "islands") {
        mask.islands_mm = number_in(value, 0.0);
        if (!mask.islands_mm && !reset) return refused("islands takes a length in mm, or auto");
    } else if (key == "root") {
        mask.root = place_in(value);
        if (!mask.root && !reset) return refused("root takes a place as X,Y,Z in mm (RAS), or auto");
    } else {
        return fail(std::string(key) + " is no option of masks", {},
                    "labels, isovalue, fill-holes, bulge-size, islands or root");
    }
    return mask;
}

io::MaskReading over(const io::MaskReading& said, io::MaskReading session) {
    if (said.labels) session.labels = said.labels;
    if (said.isovalue) session.isovalue = said.isovalue;
    if (said.bulge_size) session.bulge_size = said.bulge_size;
    if (said.islands_mm) session.islands_mm = said.islands_mm;
    if (said.fill_holes) session.fill_holes = said.fill_holes;
    if (said.root) session.root = said.root;
    return session;
}

std::string spelled(const std::vector<std::vector<volume::LabelChoice>>& labels) {
    const auto word = [](const volume::LabelChoice& label) { return volume::spelled(label); };
    return labels.empty() ? "together"
                          : joined(labels, ",", [&](const auto& group) { return joined(group, "+", word); });
}

std::string exact_place(const glm::dvec3& place) {
    return exact_text(place.x) + "," + exact_text(place.y) + "," + exact_text(place.z);
}

} // namespace ramus::app
