#include "app/assets/measured.h"

#include "app/assets/plan.h"
#include "app/session/numbers.h"
#include "core/measure/branch_point.h"
#include "core/measure/tree_measure.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::app {

namespace {

std::string branch_text(int id) { return "branch " + std::to_string(id); }

std::string place_text(const glm::dvec3& p) {
    std::string text = "(";
    for (int k = 0; k < 3; ++k) text.append(k > 0 ? ", " : "").append(digits(p[k], std::abs(p[k]) >= 100.0 ? 4 : 3));
    return text + ")";
}

// From direction `a` to `b` about `centre`, the short way; empty where they are one.
std::vector<glm::dvec3> arc(const glm::dvec3& centre, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const double angle = std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)), sine = std::sin(angle);
    std::vector<glm::dvec3> points;
    if (sine < 1e-6) return points;
    constexpr int kSteps = 32;
    for (int i = 0; i <= kSteps; ++i) {
        const double t = double(i) / kSteps;
        points.push_back(centre + radius * (std::sin((1.0 - t) * angle) * a + std::sin(t * angle) * b) / sine);
    }
    return points;
}

Measured distance(const tree::VesselTree& tree, const Measurement& m) {
    Measured found{.kind = "Distance",
                   .what = place_text(m.points[0]) + " to " + place_text(m.points[1]),
                   .value = glm::distance(m.points[0], m.points[1]),
                   .unit = Lengths(tree.claims).unit()};
    found.lines = {{m.points[0], m.points[1]}};
    found.label = found.value_text();
    found.label_place = 0.5 * (m.points[0] + m.points[1]);
    return found;
}

Result<Measured> path(const tree::VesselTree& tree, const Measurement& m) {
    auto way = measure::path_between(tree, m.branches[0], m.branches[1]);
    if (!way)
        return fail("no way leads from " + branch_text(m.branches[0]) + " to " + branch_text(m.branches[1]), {},
                    "they belong to separate trees");
    Measured found{.kind = "Path",
                   .what = branch_text(m.branches[0]) + " to " + branch_text(m.branches[1]),
                   .value = way->length_mm,
                   .unit = Lengths(tree.claims).unit()};
    found.details = {{"straight", Lengths(tree.claims).text(glm::distance(way->places.front(), way->places.back()))},
                     {"branches on the way", grouped(way->branches.size())}};
    found.label = "path " + found.value_text();
    found.label_place = way->places[way->places.size() / 2];
    found.lines = {std::move(way->places)};
    return found;
}

Measured diameter(const tree::VesselTree& tree, const Measurement& m) {
    const measure::BranchPoint place = measure::point_on(tree, m.branches[0], m.fraction);
    Measured found{.kind = "Diameter",
                   .what = branch_text(m.branches[0]) + " at " + digits(100.0 * m.fraction, 3) + " %",
                   .value = 2.0 * place.radius_mm,
                   .unit = Lengths(tree.claims).unit()};
    found.details = {
        {"cross-section", Lengths(tree.claims).text(std::numbers::pi * place.radius_mm * place.radius_mm) + "\xC2\xB2"},
        {"place", place_text(place.position)}};
    found.lines = {ring_around(place.position, place.direction, place.radius_mm)};
    found.label = "\xD8 " + found.value_text(); // in the fonts' encoding
    found.label_place = found.lines[0][found.lines[0].size() / 8];
    return found;
}

// The legs drawn are those between which the angle lies: where the parent would have gone on, or, at a root, where the
// first other branch goes.
Result<Measured> angle(const tree::VesselTree& tree, const Measurement& m) {
    const int id = m.branches[0];
    const measure::Branching branching = measure::branching_of(tree, id);
    const int parent = tree.branches[static_cast<std::size_t>(id)].parent;
    if (!branching.to_parent_deg && branching.siblings_deg.empty())
        return fail("nothing branches where " + branch_text(id) + " begins", {}, "choose a branch beyond the root's");
    Measured found{.kind = "Angle", .unit = "\xC2\xB0"};
    const glm::dvec3 own = measure::start_direction(tree, id);
    glm::dvec3 other;
    auto siblings = branching.siblings_deg;
    if (branching.to_parent_deg) {
        found.value = *branching.to_parent_deg;
        found.what = branch_text(parent) + " to " + branch_text(id);
        other = measure::end_direction(tree, parent);
    } else {
        found.value = siblings.front().second;
        found.what = branch_text(siblings.front().first) + " to " + branch_text(id);
        other = measure::start_direction(tree, siblings.front().first);
        siblings.erase(siblings.begin());
    }
    for (const auto& [sibling, degrees] : siblings)
        found.details.emplace_back("to " + branch_text(sibling), digits(degrees) + "\xC2\xB0");
    const double reach = 6.0 * measure::point_on(tree, id, 0.0).radius_mm;
    found.lines = {{branching.place + reach * own, branching.place, branching.place + reach * other}};
    found.label = digits(found.value) + "\xB0";
    found.label_place = branching.place + 0.7 * reach * own;
    if (auto bow = arc(branching.place, own, other, 0.7 * reach); !bow.empty()) {
        found.label_place = bow[bow.size() / 2];
        found.lines.push_back(std::move(bow));
    }
    return found;
}

} // namespace

std::string Measured::value_text() const { return digits(value) + (unit == "\xC2\xB0" ? "" : " ") + unit; }

std::string Measured::sentence() const {
    std::string text = kind + ", " + what + ": " + value_text();
    for (const auto& [name, detail] : details) text += ", " + name + " " + detail;
    return text;
}

Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement) {
    const bool of_places = measurement.kind == Measurement::Kind::kDistance;
    const int ends = of_places ? 0 : measurement.kind == Measurement::Kind::kPath ? 2 : 1;
    for (int i = 0; i < ends; ++i)
        if (const int id = measurement.branches[i]; id < 0 || static_cast<std::size_t>(id) >= tree.branches.size())
            return fail("there is no " + branch_text(id));
    switch (measurement.kind) {
    case Measurement::Kind::kDistance:
        return distance(tree, measurement);
    case Measurement::Kind::kPath:
        return path(tree, measurement);
    case Measurement::Kind::kDiameter:
        return diameter(tree, measurement);
    case Measurement::Kind::kAngle:
        return angle(tree, measurement);
    }
    return fail("this cannot be measured");
}

} // namespace ramus::app
