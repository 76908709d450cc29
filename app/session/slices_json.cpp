#include "app/session/slices_json.h"

#include "app/session/json_values.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app::session_json {

namespace {

constexpr double kFarthest = 1e9; // mm
constexpr double kMostZoom = 1000.0;

json place_json(const glm::dvec3& place) { return {place.x, place.y, place.z}; }

glm::dvec3 place_in(const json& value, const std::string& name) {
    if (!value.is_array() || value.size() != 3) throw Refusal{name + " is not [x, y, z]"};
    glm::dvec3 place;
    for (int axis = 0; axis < 3; ++axis)
        place[axis] = number(value[static_cast<std::size_t>(axis)], name, -kFarthest, kFarthest);
    return place;
}

json zoom_json(const SliceZoom& zoom) { return {{"factor", zoom.factor}, {"shift", {zoom.shift.x, zoom.shift.y}}}; }

SliceZoom zoom_in(const json& value) {
    expect_only(value, "a zoom of slices", {"factor", "shift"});
    SliceZoom zoom;
    if (value.contains("factor")) zoom.factor = number(value["factor"], "factor of a zoom", 1.0 / kMostZoom, kMostZoom);
    const json shift = list_in(value, "shift");
    if (!shift.empty() && shift.size() != 2) throw Refusal{"the shift of a zoom is not [right, down]"};
    if (!shift.empty())
        zoom.shift = {number(shift[0], "shift", -kFarthest, kFarthest),
                      number(shift[1], "shift", -kFarthest, kFarthest)};
    return zoom;
}

// A direction of any length but 0. One of unit length is kept to the last digit.
glm::dvec3 direction_of(const json& value, const std::string& name) {
    const glm::dvec3 direction = place_in(value, name);
    const double length = glm::length(direction);
    if (!(length > 0.0)) throw Refusal{name + " is 0"};
    constexpr double kRounding = 1e-12;
    return std::abs(length - 1.0) < kRounding ? direction : direction / length;
}

json stretch_json(const Stretch& stretch) { return {stretch.from_mm, stretch.to_mm}; }

Stretch stretch_in(const json& value, const std::string& name) {
    if (!value.is_array() || value.size() != 2) throw Refusal{name + " is not [from, to]"};
    return {number(value[0], name, 0.0, kFarthest), number(value[1], name, 0.0, kFarthest)};
}

json along_json(const AlongVessel& along) {
    json value{{"way", text_of(along.way)}, {"at", along.at_mm}, {"kind", slice::name_of(along.kind)}};
    if (along.angle_deg != 0.0) value["degrees"] = along.angle_deg;
    if (along.width_mm) value["width"] = *along.width_mm;
    if (!along.stenosis) return value;
    json& stenosis = value["stenosis"] = {{"where", stretch_json(along.stenosis->where)}};
    if (along.stenosis->reference) stenosis["reference"] = stretch_json(*along.stenosis->reference);
    if (along.stenosis->reference_mm) stenosis["diameter"] = *along.stenosis->reference_mm;
    return value;
}

StenosisChoice stenosis_in(const json& value) {
    expect_only(value, "stenosis", {"where", "reference", "diameter"});
    if (!value.contains("where")) throw Refusal{"stenosis has no where"};
    StenosisChoice stenosis{stretch_in(value["where"], "where of the stenosis")};
    if (value.contains("reference")) stenosis.reference = stretch_in(value["reference"], "reference of the stenosis");
    if (value.contains("diameter"))
        stenosis.reference_mm = number(value["diameter"], "diameter of the reference", kLeastWidthMm, kMostWidthMm);
    return stenosis;
}

AlongVessel along_in(const json& value) {
    expect_only(value, "along", {"way", "at", "kind", "degrees", "width", "stenosis"});
    if (!value.contains("way")) throw Refusal{"along has no way"};
    AlongVessel along;
    along.way = word(value["way"], "way", "way", way_in);
    if (value.contains("at")) along.at_mm = number(value["at"], "place along a vessel", 0.0, kFarthest);
    if (value.contains("kind")) along.kind = word(value["kind"], "kind", "kind", slice::reformation_named);
    if (value.contains("degrees")) along.angle_deg = number(value["degrees"], "degrees", -360.0, 360.0);
    if (value.contains("width")) along.width_mm = number(value["width"], "width", kLeastWidthMm, kMostWidthMm);
    if (value.contains("stenosis")) along.stenosis = stenosis_in(value["stenosis"]);
    return along;
}

slice::Direction direction_in(const json& value) { return word(value, "slice", "slice", slice::direction_named); }

} // namespace

json slices_json(const SliceViews& views) {
    const SliceViews usual;
    if (views == usual) return {};
    json value{{"layout", name_of(views.layout)}};
    if (views.crosshair) value["crosshair"] = place_json(*views.crosshair);
    if (views.oblique_normal != usual.oblique_normal) value["normal"] = place_json(views.oblique_normal);
    if (views.oblique_right) value["right"] = place_json(*views.oblique_right);
    if (views.along) value["along"] = along_json(*views.along);
    for (const auto& [direction, name] : slice::kDirections) {
        if (views.zooms[slice_index(direction)] != SliceZoom{})
            value["zooms"][name] = zoom_json(views.zooms[slice_index(direction)]);
        if (views.in_picture[slice_index(direction)]) value["in_picture"].push_back(name);
    }
    if (views.cut_away) value["cut_away"] = slice::name_of(*views.cut_away);
    if (views.cut_behind) value["cut_behind"] = true;
    if (views.sampling.interpolation == slice::Interpolation::kNearest) value["nearest"] = true;
    if (views.sampling.slab_mm > 0.0)
        value["slab"] = {{"mm", views.sampling.slab_mm}, {"of", slice::name_of(views.sampling.slab)}};
    if (!views.outlines) value["outlines"] = false;
    if (!views.axes) value["axes"] = false;
    if (!views.crosshair_lines) value["crosshair_lines"] = false;
    return value;
}

SliceViews slices_in(const json& value) {
    expect_only(value, "slices",
                {"layout", "crosshair", "normal", "right", "along", "zooms", "in_picture", "cut_away", "cut_behind",
                 "nearest", "slab", "outlines", "axes", "crosshair_lines"});
    SliceViews views;
    if (value.contains("layout")) views.layout = word(value["layout"], "layout", "layout", layout_named);
    if (value.contains("crosshair")) views.crosshair = place_in(value["crosshair"], "crosshair");
    if (value.contains("normal"))
        views.oblique_normal = direction_of(value["normal"], "the normal of the oblique slice");
    if (value.contains("right")) views.oblique_right = direction_of(value["right"], "the right of the oblique slice");
    if (value.contains("along")) views.along = along_in(value["along"]);
    if (value.contains("zooms")) {
        if (!value["zooms"].is_object()) throw Refusal{"zooms is not an object"};
        for (const auto& [name, zoom] : value["zooms"].items())
            views.zooms[slice_index(direction_in(name))] = zoom_in(zoom);
    }
    for (const json& name : list_in(value, "in_picture")) views.in_picture[slice_index(direction_in(name))] = true;
    if (value.contains("cut_away")) views.cut_away = direction_in(value["cut_away"]);
    if (value.contains("cut_behind")) views.cut_behind = truth(value["cut_behind"], "cut_behind");
    if (value.contains("nearest") && truth(value["nearest"], "nearest"))
        views.sampling.interpolation = slice::Interpolation::kNearest;
    if (value.contains("slab")) {
        expect_only(value["slab"], "slab", {"mm", "of"});
        if (!value["slab"].contains("mm")) throw Refusal{"slab has no mm"};
        views.sampling.slab_mm = number(value["slab"]["mm"], "thickness of the slab", 0.0, kMostSlabMm);
        if (value["slab"].contains("of"))
            views.sampling.slab = word(value["slab"]["of"], "slab", "slab", slice::slab_named);
    }
    if (value.contains("outlines")) views.outlines = truth(value["outlines"], "outlines");
    if (value.contains("axes")) views.axes = truth(value["axes"], "axes");
    if (value.contains("crosshair_lines")) views.crosshair_lines = truth(value["crosshair_lines"], "crosshair_lines");
    return views;
}

} // namespace ramus::app::session_json
