#include "app/measured.h"

#include "app/numbers.h"
#include "core/measure/branch_place.h"
#include "core/measure/tree_measure.h"

#include <cmath>
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

Measured distance(const Measurement& m) {
    return {"Distance",
            place_text(m.points[0]) + " to " + place_text(m.points[1]),
            glm::distance(m.points[0], m.points[1]),
            "mm",
            {},
            {m.points[0], m.points[1]}};
}

Result<Measured> path(const tree::VesselTree& tree, const Measurement& m) {
    auto way = measure::path_between(tree, m.branches[0], m.branches[1]);
    if (!way)
        return fail("no way leads from " + branch_text(m.branches[0]) + " to " + branch_text(m.branches[1]), {},
                    "they belong to separate trees");
    Measured found{"Path", branch_text(m.branches[0]) + " to " + branch_text(m.branches[1]), way->length_mm, "mm", {},
                   {}};
    found.details = {{"straight", digits(glm::distance(way->places.front(), way->places.back())) + " mm"},
                     {"branches on the way", grouped(way->branches.size())}};
    found.line = std::move(way->places);
    return found;
}

Measured diameter(const tree::VesselTree& tree, const Measurement& m) {
    const measure::BranchPlace place = measure::place_on(tree, m.branches[0], m.fraction);
    Measured found{"Diameter",
                   branch_text(m.branches[0]) + " at " + digits(100.0 * m.fraction, 3) + " %",
                   2.0 * place.radius_mm,
                   "mm",
                   {{"cross-section", digits(std::numbers::pi * place.radius_mm * place.radius_mm) + " mm\xC2\xB2"},
                    {"place", place_text(place.position)}},
                   {}};
    const glm::dvec3& n = place.direction;
    const glm::dvec3 aside =
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(n, aside);
    constexpr int kCorners = 48; // of the ring around the cross-section
    for (int i = 0; i <= kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        found.line.push_back(place.position + place.radius_mm * (std::cos(angle) * aside + std::sin(angle) * up));
    }
    return found;
}

Result<Measured> angle(const tree::VesselTree& tree, const Measurement& m) {
    const int id = m.branches[0];
    const measure::Branching branching = measure::branching_of(tree, id);
    const int parent = tree.branches[static_cast<std::size_t>(id)].parent;
    if (!branching.to_parent_deg && branching.siblings_deg.empty())
        return fail("nothing branches where " + branch_text(id) + " begins", {}, "choose a branch beyond the root's");
    Measured found{"Angle", {}, 0.0, "\xC2\xB0", {}, {}};
    const double arm = 2.0 * 1.5 * tree.points[tree.branches[static_cast<std::size_t>(id)].points.front()].radius;
    glm::dvec3 other;
    auto siblings = branching.siblings_deg;
    if (branching.to_parent_deg) {
        found.value = *branching.to_parent_deg;
        found.what = branch_text(parent) + " to " + branch_text(id);
        other = -measure::end_direction(tree, parent);
    } else {
        found.value = siblings.front().second;
        found.what = branch_text(siblings.front().first) + " to " + branch_text(id);
        other = measure::start_direction(tree, siblings.front().first);
        siblings.erase(siblings.begin());
    }
    for (const auto& [sibling, degrees] : siblings)
        found.details.emplace_back("to " + branch_text(sibling), digits(degrees) + "\xC2\xB0");
    found.line = {branching.place + arm * other, branching.place,
                  branching.place + arm * measure::start_direction(tree, id)};
    return found;
}

} // namespace

std::string Measured::value_text() const { return digits(value) + (unit == "mm" ? " mm" : unit); }

std::string Measured::sentence() const {
    std::string text = kind + ", " + what + ": " + value_text();
    for (const auto& [name, detail] : details) text += ", " + name + " " + detail;
    return text;
}

Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement) {
    switch (measurement.kind) {
    case Measurement::Kind::kDistance:
        return distance(measurement);
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
