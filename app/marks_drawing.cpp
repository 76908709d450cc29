#include "app/marks_drawing.h"

#include "app/numbers.h"
#include "core/measure/branch_place.h"
#include "core/measure/tree_measure.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::app {

namespace {

constexpr glm::vec3 kCutColour{0.94F, 0.95F, 0.97F}, kReconstructColour{1.00F, 0.62F, 0.20F},
    kMeasureColour{0.55F, 0.93F, 0.82F};

std::vector<glm::dvec3> circle(const glm::dvec3& centre, const glm::dvec3& axis, double radius) {
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    constexpr int kSteps = 72;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = glm::two_pi<double>() * (i % kSteps) / kSteps;
        points.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return points;
}

// From direction `a` to `b` about `centre`, the short way.
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

bool has(const tree::VesselTree& tree, int branch) {
    return branch >= 0 && static_cast<std::size_t>(branch) < tree.branches.size();
}

void draw_distance(render::Frame& frame, const Measurement& m) {
    frame.lines.push_back({{m.points[0], m.points[1]}, kMeasureColour});
    frame.labels.push_back(
        {0.5 * (m.points[0] + m.points[1]), digits(glm::distance(m.points[0], m.points[1])) + " mm"});
}

void draw_path(render::Frame& frame, const tree::VesselTree& tree, const Measurement& m) {
    if (!has(tree, m.branches[0]) || !has(tree, m.branches[1])) return;
    const auto path = measure::path_between(tree, m.branches[0], m.branches[1]);
    if (!path || path->places.empty()) return;
    frame.lines.push_back({path->places, kMeasureColour});
    frame.labels.push_back({path->places[path->places.size() / 2], "path " + digits(path->length_mm) + " mm"});
}

void draw_diameter(render::Frame& frame, const tree::VesselTree& tree, const Measurement& m) {
    if (!has(tree, m.branches[0])) return;
    const measure::BranchPlace place = measure::place_on(tree, m.branches[0], m.fraction);
    frame.lines.push_back({circle(place.position, place.direction, place.radius_mm), kMeasureColour});
    const auto& ring = frame.lines.back().points;
    frame.labels.push_back({ring[ring.size() / 8], "\xD8 " + digits(2.0 * place.radius_mm) + " mm"});
}

// The angle that measured() tells, and no other: where the parent would have gone on, or, at a root, where the first
// other branch goes.
void draw_angle(render::Frame& frame, const tree::VesselTree& tree, const Measurement& m) {
    if (!has(tree, m.branches[0])) return;
    const int branch = m.branches[0];
    const measure::Branching found = measure::branching_of(tree, branch);
    if (!found.to_parent_deg && found.siblings_deg.empty()) return;
    const int parent = tree.branches[static_cast<std::size_t>(branch)].parent;
    const glm::dvec3 own = measure::start_direction(tree, branch);
    const glm::dvec3 other = found.to_parent_deg ? measure::end_direction(tree, parent)
                                                 : measure::start_direction(tree, found.siblings_deg.front().first);
    const double degrees = found.to_parent_deg ? *found.to_parent_deg : found.siblings_deg.front().second;
    const double reach = 3.0 * 2.0 * measure::place_on(tree, branch, 0.0).radius_mm;
    frame.lines.push_back({{found.place + reach * own, found.place, found.place + reach * other}, kMeasureColour});
    const auto bow = arc(found.place, own, other, 0.7 * reach);
    if (!bow.empty()) frame.lines.push_back({bow, kMeasureColour});
    frame.labels.push_back(
        {bow.empty() ? found.place + 0.7 * reach * own : bow[bow.size() / 2], digits(degrees) + "\xB0"});
}

} // namespace

void draw_marks(render::Frame& frame, const tree::VesselTree& tree, const Marks& marks, const Plan* plan) {
    for (std::size_t i = 0; i < marks.cuts.size() && frame.centerlines; ++i) {
        const auto& [branch, fraction] = marks.cuts[i];
        const auto place = frame.centerlines->at(branch, fraction);
        if (!place || state_of(marks, branch) == render::BranchState::kHidden) continue;
        const bool reconstruct = plan != nullptr && i < plan->cuts.cuts.size() && plan->cuts.cuts[i].reconstruct;
        frame.lines.push_back({circle(place->position, place->along, 1.35 * place->radius_mm),
                               reconstruct ? kReconstructColour : kCutColour, 2.2F});
    }
    for (const Measurement& m : marks.measurements) switch (m.kind) {
        case Measurement::Kind::kDistance:
            draw_distance(frame, m);
            break;
        case Measurement::Kind::kPath:
            draw_path(frame, tree, m);
            break;
        case Measurement::Kind::kDiameter:
            draw_diameter(frame, tree, m);
            break;
        case Measurement::Kind::kAngle:
            draw_angle(frame, tree, m);
            break;
        }
}

} // namespace ramus::app
