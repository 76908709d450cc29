#include "app/assets/measured.h"

#include "app/assets/assets.h"
#include "app/assets/plan.h"
#include "app/session/document.h"
#include "app/session/numbers.h"
#include "core/measure/branch_point.h"
#include "core/measure/tree_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

namespace ramus::app {

namespace {

std::string branch_text(int id) { return "branch " + std::to_string(id); }

std::string place_text(const glm::dvec3& p) {
    std::string text = "(";
    for (int k = 0; k < 3; ++k) text.append(k > 0 ? ", " : "").append(digits(p[k], std::abs(p[k]) >= 100.0 ? 4 : 3));
    return text + ")";
}

// The shorter arc from direction `a` to `b` about `centre`; empty if they are equal.
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

std::string at_text(const measure::BranchPlace& place) {
    return branch_text(place.branch) + " at " + digits(100.0 * place.fraction, 3) + " %";
}

// Half-way along a line.
glm::dvec3 middle_of(const std::vector<glm::dvec3>& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
    double left = 0.5 * length;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const double step = glm::distance(line[i - 1], line[i]);
        if (step > 0.0 && left <= step) return glm::mix(line[i - 1], line[i], left / step);
        left -= step;
    }
    return line.back();
}

Result<measure::Lesion> lesion_of(const LesionShapes& lesions, int id) {
    if (const auto found = lesions.at(id)) return *found;
    if (lesions.find(id) == nullptr)
        return fail("the lesion that this is measured from is not there", {}, "remove it, and measure again");
    return fail(lesions.name_of(id) + " has not been read");
}

// The shortest distance from the surface of a lesion to the wall of a branch.
Result<Measured> shortest(const tree::VesselTree& tree, const Measurement& m, const LesionShapes& lesions) {
    RAMUS_TRY(lesion, lesion_of(lesions, m.lesions[0]));
    const std::array branch{m.places[0].branch};
    const measure::NearestWall nearest = measure::nearest_wall(tree, branch, lesion);
    const Lengths lengths(tree.claims);
    Measured found{.kind = "Shortest distance",
                   .what = lesions.name_of(m.lesions[0]) + " to the wall of " + branch_text(branch[0]) + " at " +
                           digits(100.0 * nearest.fraction, 3) + " %",
                   .value = nearest.distance_mm,
                   .unit = lengths.unit()};
    if (nearest.overlap_mm > 0.0) found.details = {{"overlap", lengths.text(nearest.overlap_mm)}};
    found.lines = {{nearest.on_lesion, nearest.on_wall}};
    found.label = found.value_text();
    found.label_place = 0.5 * (nearest.on_lesion + nearest.on_wall);
    return found;
}

// Fails if a point that is to be on a lesion is not: the measurement would no longer mean what was requested.
Result<void> check_on(const LesionShapes& lesions, int lesion, const glm::dvec3& point) {
    if (lesion == kNoObject) return {};
    RAMUS_TRY(shape, lesion_of(lesions, lesion));
    constexpr double kOff = 1e-3; // of its size: precision of meshes, and of places as text
    const double size = shape.mesh ? glm::length(shape.mesh->bounds().size()) : 2.0 * shape.sphere[3];
    if (std::abs(measure::signed_distance(shape, point)) <= kOff * size) return {};
    return fail("the place " + place_text(point) + " is no longer on " + lesions.name_of(lesion), {},
                "remove it, and measure again");
}

Result<Measured> distance(const tree::VesselTree& tree, const Measurement& m, const LesionShapes& lesions) {
    if (m.shortest) return shortest(tree, m, lesions);
    const auto end_text = [&](std::size_t i) {
        return (m.lesions[i] != kNoObject ? lesions.name_of(m.lesions[i]) + " at " : "") + place_text(m.points[i]);
    };
    for (std::size_t i = 0; i < m.points.size(); ++i)
        if (auto on = check_on(lesions, m.lesions[i], m.points[i]); !on) return tl::unexpected(on.error());
    Measured found{.kind = "Distance",
                   .what = end_text(0) + " to " + end_text(1),
                   .value = glm::distance(m.points[0], m.points[1]),
                   .unit = Lengths(tree.claims).unit()};
    found.lines = {{m.points[0], m.points[1]}};
    found.label = found.value_text();
    found.label_place = 0.5 * (m.points[0] + m.points[1]);
    return found;
}

Result<Measured> path(const tree::VesselTree& tree, const Measurement& m) {
    auto way = measure::path_between(tree, m.places[0], m.places[1]);
    if (!way)
        return fail("no way leads from " + branch_text(m.places[0].branch) + " to " + branch_text(m.places[1].branch),
                    {}, "they belong to separate trees");
    Measured found{.kind = "Path",
                   .what = at_text(m.places[0]) + " to " + at_text(m.places[1]),
                   .value = way->length_mm,
                   .unit = Lengths(tree.claims).unit()};
    found.details = {{"straight", Lengths(tree.claims).text(glm::distance(way->places.front(), way->places.back()))},
                     {"branches on the path", grouped(way->branches.size())}};
    found.label = "path " + found.value_text();
    found.label_place = middle_of(way->places);
    found.lines = {std::move(way->places)};
    for (const int branch : way->branches)
        for (const std::uint32_t point : tree.branches[static_cast<std::size_t>(branch)].points)
            found.inside_mm = std::max(found.inside_mm, tree.points[point].radius);
    return found;
}

Measured diameter(const tree::VesselTree& tree, const Measurement& m) {
    const measure::BranchPoint place = measure::point_on(tree, m.places[0]);
    const double area = std::numbers::pi * place.radius_mm * place.radius_mm;
    Measured found{.kind = "Diameter",
                   .what = at_text(m.places[0]),
                   .value = 2.0 * place.radius_mm,
                   .unit = Lengths(tree.claims).unit()};
    found.details = {{"cross-section", Lengths(tree.claims).area(area)}, {"place", place_text(place.position)}};
    found.lines = {ring_around(place.position, place.direction, place.radius_mm)};
    found.label = "\xD8 " + found.value_text(); // in the fonts' encoding
    found.label_place = found.lines[0][found.lines[0].size() / 8];
    return found;
}

// Draws an angle at `apex` between two unit directions: legs of the given length, an arc, and the label.
void draw_angle(Measured& found, const glm::dvec3& apex, std::array<glm::dvec3, 2> directions,
                std::array<double, 2> legs) {
    found.lines = {{apex + legs[0] * directions[0], apex, apex + legs[1] * directions[1]}};
    found.label = digits(found.value) + "\xB0";
    const double reach = 0.7 * std::min(legs[0], legs[1]);
    found.label_place = apex + reach * directions[0];
    if (auto bow = arc(apex, directions[0], directions[1], reach); !bow.empty()) {
        found.label_place = bow[bow.size() / 2];
        found.lines.push_back(std::move(bow));
    }
}

Result<Measured> angle_between(const tree::VesselTree& tree, const Measurement& m) {
    Measured found{.kind = "Angle", .unit = "\xC2\xB0"};
    const std::vector<glm::dvec3> ends = ends_of(tree, m);
    const glm::dvec3 apex = ends[1];
    const std::array ways{ends[0] - apex, ends[2] - apex};
    const std::array legs{glm::length(ways[0]), glm::length(ways[1])};
    if (!(legs[0] > 0.0 && legs[1] > 0.0))
        return fail("there is no angle between places that are one", {}, "choose three that are apart");
    found.value = measure::angle_deg(ends[0], apex, ends[2]);
    found.what = at_text(m.places[0]) + ", " + at_text(m.places[1]) + ", " + at_text(m.places[2]);
    draw_angle(found, apex, {ways[0] / legs[0], ways[1] / legs[1]}, legs);
    return found;
}

// Draws the legs of the angle: the parent's continuation, or at a root the first other branch; and the branch.
Result<Measured> angle_of_branching(const tree::VesselTree& tree, const Measurement& m) {
    const int id = m.places[0].branch;
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
    draw_angle(found, branching.place, {own, other}, {reach, reach});
    return found;
}

} // namespace

std::string Measured::value_text() const { return digits(value) + (unit == "\xC2\xB0" ? "" : " ") + unit; }

std::string Measured::sentence() const {
    std::string text = kind + ", " + what + ": " + value_text();
    for (const auto& [name, detail] : details) text += ", " + name + " " + detail;
    return text;
}

std::vector<glm::dvec3> ends_of(const tree::VesselTree& tree, const Measurement& measurement) {
    const auto points = std::span(measurement.points).first(point_count(measurement));
    std::vector<glm::dvec3> ends(points.begin(), points.end());
    if (of_branching(measurement) || measurement.shortest) return ends;
    for (const measure::BranchPlace& place : std::span(measurement.places).first(place_count(measurement)))
        if (place.branch >= 0 && static_cast<std::size_t>(place.branch) < tree.branches.size())
            ends.push_back(measure::point_on(tree, place).position);
    return ends;
}

const LesionShapes::Shape* LesionShapes::find(int id) const {
    const auto shape = std::ranges::find(shapes, id, [](const Shape& one) { return one.lesion.id; });
    return id == kNoObject || shape == shapes.end() ? nullptr : &*shape;
}

std::optional<measure::Lesion> LesionShapes::at(int id) const {
    const Shape* shape = find(id);
    if (shape == nullptr || !shape->is_there()) return {};
    return shape->mesh ? measure::Lesion{{}, shape->mesh} : measure::Lesion{shape->lesion.sphere, nullptr};
}

std::string LesionShapes::name_of(int id) const {
    const Shape* shape = find(id);
    return shape == nullptr ? "a lesion" : "lesion " + std::to_string(shape - shapes.data() + 1);
}

int LesionShapes::picked(int lesion) const {
    for (const Shape& shape : shapes)
        if ((shape.lesion.visible || !shape.lesion.is_mesh()) && shape.is_there() && lesion-- == 0)
            return shape.lesion.id;
    return kNoObject;
}

LesionShapes lesion_shapes(const Assets& assets, const Marks& marks) {
    LesionShapes shapes;
    for (const Lesion& lesion : marks.lesions) {
        const auto mesh = assets.lesion_mesh(lesion);
        shapes.shapes.push_back({lesion, mesh ? mesh->distance : nullptr});
    }
    return shapes;
}

std::shared_ptr<const tree::VesselTree> measured_tree(const Document& document) {
    if (document.tree()) return document.tree();
    auto none = std::make_shared<tree::VesselTree>();
    none->claims = document.claims();
    return none;
}

Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement, const LesionShapes& lesions) {
    for (std::size_t i = 0; i < place_count(measurement); ++i)
        if (const int id = measurement.places[i].branch; id < 0 || static_cast<std::size_t>(id) >= tree.branches.size())
            return fail("there is no " + branch_text(id));
    auto found = [&]() -> Result<Measured> {
        switch (measurement.kind) {
        case Measurement::Kind::kDistance:
            return distance(tree, measurement, lesions);
        case Measurement::Kind::kPath:
            return path(tree, measurement);
        case Measurement::Kind::kDiameter:
            return diameter(tree, measurement);
        case Measurement::Kind::kAngle:
            return of_branching(measurement) ? angle_of_branching(tree, measurement) : angle_between(tree, measurement);
        }
        return fail("this cannot be measured");
    }();
    if (!found) return found;
    found->ends = measurement.shortest ? found->lines.front() : ends_of(tree, measurement);
    return found;
}

} // namespace ramus::app
