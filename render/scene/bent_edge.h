// Computes bent edges: curves between two vertices that follow a smooth surface by the vertices' normals. On cylinders
// and spheres with exact normals the middle of a bent edge lies on the surface. Elsewhere its error is of third order
// in the edge's length; that of a straight edge is of second order. Results depend only on the two ends, not on their
// order, bit by bit, so that triangles with a common edge stay connected.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <tuple>

namespace ramus::render {

// The largest bend, in lengths of the edge. Larger bends count as creases.
inline constexpr float kMostBend = 0.15F;

struct EdgeEnd {
    glm::vec3 position, normal; // normal: of unit length
};

// Returns the vector from the middle of the straight edge to the middle of the bent edge; 0 across creases.
//
// A cubic that is perpendicular to the normals at its ends (Vlachos et al., Curved PN Triangles, 2001) has its middle
// ((e . nb) nb - (e . na) na) / 8 away from the middle of the chord e. On an arc of radius r whose normals include the
// angle 2x, this is r sin^2 x cos x / 2, whereas the arc is r (1 - cos x) away. The factor 2 / ((1 + cos x) cos x)
// corrects that.
[[nodiscard]] inline glm::vec3 bend_of(const EdgeEnd& one, const EdgeEnd& other) {
    constexpr float kLeastCosine = 0.4F; // of normals that belong to one smooth surface
    const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
    const bool in_order = key(one.position) < key(other.position);
    const EdgeEnd &a = in_order ? one : other, &b = in_order ? other : one;
    const float cosine = glm::dot(a.normal, b.normal);
    if (!(cosine > kLeastCosine)) return glm::vec3(0.0F);
    const glm::vec3 edge = b.position - a.position;
    const float half = std::sqrt(std::min(0.5F + 0.5F * cosine, 1.0F)), factor = 0.25F / ((1.0F + half) * half);
    const glm::vec3 bend = factor * (glm::dot(edge, b.normal) * b.normal - glm::dot(edge, a.normal) * a.normal);
    const bool crease = glm::dot(bend, bend) > kMostBend * kMostBend * glm::dot(edge, edge);
    return crease ? glm::vec3(0.0F) : bend;
}

// The middle of the bent edge. Its normal is the mean of the ends' normals, reflected as for the cubic (ibid., section
// 3.3).
[[nodiscard]] inline EdgeEnd middle_of(const EdgeEnd& one, const EdgeEnd& other) {
    const glm::vec3 edge = other.position - one.position, sum = one.normal + other.normal;
    const float squared = glm::dot(edge, edge);
    const glm::vec3 normal = squared > 0.0F ? sum - 2.0F * glm::dot(edge, sum) / squared * edge : sum;
    const float length = glm::length(normal);
    return {0.5F * (one.position + other.position) + bend_of(one, other), length > 0.0F ? normal / length : one.normal};
}

} // namespace ramus::render
