#include "core/tree/contacts/move_apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace ramus::tree {

namespace {

// Two links that a short move may bring together or apart.
struct ClosePair {
    Link a, b;
    double thinner; // radius, mm
};

double distance_after(const ClosePair& pair, const glm::dvec3& move) {
    Link moved = pair.b;
    moved.a.position += move;
    moved.b.position += move;
    const Approach approach = closest_approach(pair.a, moved);
    return glm::distance(point_on(pair.a, approach.share_a).position, point_on(moved, approach.share_b).position) /
           pair.thinner;
}

// In radii of the thinner vessel; not looked at closer than `enough`.
double least_distance(const std::vector<ClosePair>& pairs, const glm::dvec3& move, double enough) {
    double least = std::numeric_limits<double>::max();
    for (const ClosePair& pair : pairs) {
        least = std::min(least, distance_after(pair, move));
        if (least <= enough) break;
    }
    return least;
}

// Points spread evenly over a unit sphere (a spiral with golden angles).
constexpr int kDirections = 96;
glm::dvec3 direction(int n) {
    const double z = 1.0 - (2.0 * n + 1.0) / kDirections;
    const double angle = n * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

} // namespace

glm::dvec3 move_apart(const Links& links, std::span<const OrientedPair> pairs) {
    constexpr double kFarthest = 2.0 * kLeastDistance; // of links that a move may bring too close
    std::vector<ClosePair> close;
    double thinnest = std::numeric_limits<double>::max();
    double least = kFarthest;
    for (const OrientedPair& pair : pairs) {
        const Link& a = links[pair.link[0]];
        const Link& b = links[pair.link[1]];
        const ClosePair one{a, b, std::min({a.a.radius, a.b.radius, b.a.radius, b.b.radius})};
        const double distance = distance_after(one, glm::dvec3(0.0));
        if (distance > kFarthest) continue;
        close.push_back(one);
        if (distance >= least) continue;
        least = distance;
        thinnest = one.thinner;
    }
    if (least >= kLeastDistance) return glm::dvec3(0.0);
    glm::dvec3 best(0.0);
    for (const double share : {0.5, 0.75, 1.0, 1.25, 1.5}) {
        for (int n = 0; n < kDirections; ++n) {
            const glm::dvec3 move = share * kLeastDistance * thinnest * direction(n);
            const double distance = least_distance(close, move, least);
            if (distance > least) least = distance, best = move;
        }
        if (least >= kLeastDistance) break;
    }
    return best;
}

} // namespace ramus::tree
