// Edges of a surface that bends between its vertices as their normals say. Where the surface is a cylinder or a ball,
// and the normals are its own, an edge's middle lies on it; elsewhere it is off by the third order of the edge's
// length, where the straight edge is off by the second. All that is said of an edge depends on its two ends alone, and
// not on their order, to the last bit: triangles that share it stay together.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <tuple>

namespace ramus::render {

// Of lengths of an edge: the most that it bends. What would bend more is a crease.
inline constexpr float kMostBend = 0.15F;

struct EdgeEnd {
    glm::vec3 position, normal; // normal: of unit length
};

// From the middle of the straight edge to the middle of the bent one; 0 across creases.
//
// A cubic whose ends are perpendicular to the normals there (Vlachos et al., Curved PN Triangles, 2001) has its middle
// ((e . nb) nb - (e . na) na) / 8 beside the chord e. On an arc whose normals are 2 x apart that is
// r sin^2 x cos x / 2, where the arc is r (1 - cos x) beside it: a factor 2 / ((1 + cos x) cos x) makes it that.
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

// The middle of the bent edge. Its normal is the mean of the ends', mirrored as the cubic asks (there, section 3.3).
[[nodiscard]] inline EdgeEnd middle_of(const EdgeEnd& one, const EdgeEnd& other) {
    const glm::vec3 edge = other.position - one.position, sum = one.normal + other.normal;
    const float squared = glm::dot(edge, edge);
    const glm::vec3 normal = squared > 0.0F ? sum - 2.0F * glm::dot(edge, sum) / squared * edge : sum;
    const float length = glm::length(normal);
    return {0.5F * (one.position + other.position) + bend_of(one, other), length > 0.0F ? normal / length : one.normal};
}

} // namespace ramus::render
