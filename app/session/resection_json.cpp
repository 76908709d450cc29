// Resections and plans of a session as JSON (marks_json.h).
#include "app/session/json_values.h"
#include "app/session/marks_json.h"
#include "app/session/session_limits.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app::session_json {

namespace {

using ResectionKind = Resection::Kind;

constexpr std::array<std::pair<std::string_view, ResectionKind>, 5> kResectionNames{
    {{"plane", ResectionKind::kPlane},
     {"sheet", ResectionKind::kSheet},
     {"surface", ResectionKind::kSurface},
     {"cuts", ResectionKind::kCuts},
     {"lesion", ResectionKind::kLesion}}};

json numbers_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 numbers_in(const json& value, const std::string& name) {
    if (!value.is_array() || value.size() != 3) throw Refusal{name + " is not [x, y, z]"};
    glm::dvec3 v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = session_json::number(value[static_cast<std::size_t>(axis)], name, -1e9, 1e9);
    return v;
}

json sheet_json(const organ::Sheet& sheet) {
    return {{"origin", numbers_json(sheet.origin)}, {"u", numbers_json(sheet.u)},
            {"v", numbers_json(sheet.v)},           {"step", {sheet.step.x, sheet.step.y}},
            {"size", {sheet.size.x, sheet.size.y}}, {"heights", sheet.heights},
            {"removes_below", sheet.removes_below}};
}

organ::Sheet sheet_in(const json& value) {
    constexpr int kMostControls = 1000; // along an axis
    expect_only(value, "sheet", {"origin", "u", "v", "step", "size", "heights", "removes_below"});
    organ::Sheet sheet;
    sheet.origin = numbers_in(value.value("origin", json()), "origin of a sheet");
    sheet.u = numbers_in(value.value("u", json()), "u of a sheet");
    sheet.v = numbers_in(value.value("v", json()), "v of a sheet");
    const json step = list_in(value, "step"), size = list_in(value, "size");
    if (step.size() != 2 || size.size() != 2) throw Refusal{"step and size of a sheet are not two numbers each"};
    for (int axis = 0; axis < 2; ++axis) {
        sheet.step[axis] = session_json::number(step[static_cast<std::size_t>(axis)], "step of a sheet", 0.0, 1e9);
        sheet.size[axis] = integer(size[static_cast<std::size_t>(axis)], "size of a sheet", 2, kMostControls);
    }
    for (const json& height : list_in(value, "heights"))
        sheet.heights.push_back(session_json::number(height, "height of a sheet", -1e9, 1e9));
    if (value.contains("removes_below")) sheet.removes_below = truth(value["removes_below"], "removes_below");
    if (auto good = organ::check_sheet(sheet); !good) throw Refusal{good.error().what};
    return sheet;
}

} // namespace

std::pair<int, double> cut_in(const json& value) {
    if (!value.is_array() || value.size() != 2) throw Refusal{"a cut is not [branch id, fraction]"};
    return {integer(value[0], "branch id of a cut", 0, kMostBranches), session_json::number(value[1], "cut", 0.0, 1.0)};
}

json resection_json(const Resection& resection, const Marks& marks, const std::filesystem::path& folder) {
    json value;
    for (const auto& [name, kind] : kResectionNames)
        if (kind == resection.kind) value["kind"] = std::string(name);
    switch (resection.kind) {
    case ResectionKind::kPlane:
        value["point"] = numbers_json(resection.point);
        value["normal"] = numbers_json(resection.normal);
        break;
    case ResectionKind::kSheet:
        value["sheet"] = sheet_json(resection.sheet);
        break;
    case ResectionKind::kSurface:
        value["path"] = written_path(resection.file, folder).string();
        if (!resection.axes.empty()) value["axes"] = resection.axes;
        if (resection.other_side) value["other_side"] = true;
        break;
    case ResectionKind::kLesion:
        value["lesion"] = lesion_json(resection.lesion, marks);
        [[fallthrough]];
    case ResectionKind::kCuts:
        value["margin_mm"] = resection.margin_mm;
        break;
    }
    write_object(value, resection);
    return value;
}

Resection resection_in(const json& value, const Marks& marks, const std::filesystem::path& folder) {
    Resection found;
    read_object(value, found,
                {"kind", "point", "normal", "sheet", "path", "axes", "other_side", "lesion", "margin_mm"});
    found.kind = word(value.value("kind", json()), "kind of a resection", "resection",
                      [](const std::string& name) { return paired(kResectionNames, std::string_view(name)); });
    if (found.kind == ResectionKind::kPlane) {
        found.point = numbers_in(value.value("point", json()), "point of a plane");
        const glm::dvec3 normal = numbers_in(value.value("normal", json()), "normal of a plane");
        const double length = glm::length(normal);
        if (!(length > 0.0)) throw Refusal{"the normal of a plane has no length"};
        // Written normals are of unit length, and must come back as they are.
        found.normal = std::abs(length - 1.0) < 1e-12 ? normal : normal / length;
    } else if (found.kind == ResectionKind::kSheet) {
        found.sheet = sheet_in(value.value("sheet", json()));
    } else if (found.kind == ResectionKind::kSurface) {
        const std::string path = text(value.value("path", json()), "path of a resection");
        found.file = (folder / path).lexically_normal().string();
        if (value.contains("axes")) found.axes = mesh_axes_in(value["axes"]);
        if (value.contains("other_side")) found.other_side = truth(value["other_side"], "other_side");
    }
    if (found.kind == ResectionKind::kLesion) found.lesion = lesion_in(value.value("lesion", json()), marks);
    if (value.contains("margin_mm")) found.margin_mm = session_json::number(value["margin_mm"], "margin_mm", 0.0, 1e6);
    return found;
}

json plans_json(const Marks& marks, const std::filesystem::path& folder) {
    json others = json::array();
    for (const OperationPlan& plan : marks.plans.others) {
        json resections = json::array();
        for (const Resection& one : plan.resections) resections.push_back(resection_json(one, marks, folder));
        others.push_back({{"name", plan.name}, {"cuts", plan.cuts}, {"resections", resections}});
    }
    json plans{{"name", marks.plans.name}, {"place", marks.plans.place}, {"others", others}};
    if (marks.plans.compared) plans["compared"] = *marks.plans.compared;
    return plans;
}

Plans plans_in(const json& value, const Marks& marks, const std::filesystem::path& folder) {
    expect_only(value, "plans", {"name", "place", "others", "compared"});
    Plans plans;
    if (value.contains("name")) plans.name = text(value["name"], "name of a plan");
    for (const json& one : list_in(value, "others")) {
        expect_only(one, "plan", {"name", "cuts", "resections"});
        OperationPlan plan{text(one.value("name", json()), "name of a plan"), {}, {}};
        for (const json& cut : list_in(one, "cuts")) plan.cuts.push_back(cut_in(cut));
        for (const json& resection : list_in(one, "resections"))
            plan.resections.push_back(resection_in(resection, marks, folder));
        if (plan.resections.size() > kMostResections) throw Refusal{"a plan has too many resections"};
        plans.others.push_back(std::move(plan));
    }
    const auto place = [&](const char* key, const char* what) {
        return static_cast<std::size_t>(integer(value[key], what, 0, static_cast<int>(plans.others.size())));
    };
    if (value.contains("place")) plans.place = place("place", "place of the plan");
    if (value.contains("compared")) plans.compared = place("compared", "place of the compared plan");
    if (plans.compared == plans.place) throw Refusal{"a plan is compared with itself"};
    return plans;
}

} // namespace ramus::app::session_json
