#include "core/mesh/polygonize/cells/wall_pairs.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::mesh::bricks {

namespace {

constexpr float kMostOfRoom = 0.25F; // of its least extent, that a wall may take
constexpr float kOffEnds = 0.01F;    // of an edge: so far from its ends the surface goes through it

// The wall's normal, from the first vessel to the second: of the surfaces, where they agree with the edges.
glm::vec3 normal_of(const field::OwnedPoint& first, const field::OwnedPoint& second, const glm::vec3& toward,
                    const glm::vec3& size) {
    constexpr float kAgrees = 0.5F;
    glm::vec3 between = first.normal - second.normal;
    for (int axis = 0; axis < 3; ++axis)
        if (!(size[axis] > 0.0F)) between[axis] = 0.0F;
    const float length = glm::length(between);
    const glm::vec3 along = glm::normalize(toward);
    return length > 0.1F && glm::dot(between, along) > kAgrees * length ? between / length : along;
}

} // namespace

void part(field::OwnedPoint& first, field::OwnedPoint& second, const glm::vec3& toward, const Span& room) {
    const glm::vec3 size = room.size();
    const glm::vec3 normal = normal_of(first, second, toward, size);
    float least = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis)
        if (size[axis] > 0.0F) least = std::min(least, size[axis]);
    const float gap =
        std::min(static_cast<float>(field::kWallRadii) * std::min(first.radius, second.radius), kMostOfRoom * least);
    if (const float lacking = gap - glm::dot(second.at - first.at, normal); lacking > 0.0F) {
        first.at -= 0.5F * lacking * normal;
        second.at += 0.5F * lacking * normal;
    }
    const glm::vec3 inward = glm::max(room.lower - glm::min(first.at, second.at), 0.0F) +
                             glm::min(room.upper - glm::max(first.at, second.at), 0.0F);
    first.at = glm::clamp(first.at + inward, room.lower, room.upper);
    second.at = glm::clamp(second.at + inward, room.lower, room.upper);
}

EdgeEnds ends_on_edge(field::BrickField& field, const OwnedEdge& edge) {
    const glm::vec3& lower = edge.span.lower;
    const glm::vec3& upper = edge.span.upper;
    const glm::vec3 along = edge.span.size();
    const Span room{lower + kOffEnds * along, upper - kOffEnds * along};
    const auto end_of_lower = [&] { return field.way_out(edge.lower, lower, upper, edge.guess); };
    const auto end_of_upper = [&](float guess) { return field.way_out(edge.upper, upper, lower, guess); };
    if (edge.kind != EdgeKind::kWall) {
        field::OwnedPoint end = edge.kind == EdgeKind::kLowerInside ? end_of_lower() : end_of_upper(1.0F - edge.guess);
        end.at = glm::clamp(end.at, room.lower, room.upper);
        return {end, end};
    }
    EdgeEnds ends{end_of_lower(), {}};
    // The other side is found a wall's width behind this one.
    const float width = static_cast<float>(field::kWallRadii) * ends.lower.radius;
    const float beside = 1.0F - (glm::distance(ends.lower.at, lower) + width) / glm::length(along);
    ends.upper = end_of_upper(std::clamp(beside, kOffEnds, 1.0F - kOffEnds));
    part(ends.lower, ends.upper, along, room);
    return ends;
}

} // namespace ramus::mesh::bricks
