// NearView: where a surface is looked at from, for what depends on how large it is in the picture.
#pragma once

#include "render/scene/camera.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

// Positions relative to the surface's origin.
struct NearView {
    glm::vec3 eye, forward;
    float pixels; // of a mm, at a depth of 1 mm when perspective
    bool flat;    // parallel projection
    glm::dmat4 to_clip;
    std::array<glm::vec4, 4> sides{}; // of the picture, facing inward

    // Whether the picture may show some of what is no farther than `radius` from a place.
    [[nodiscard]] bool shows(const glm::vec3& place, float radius) const {
        return std::ranges::none_of(
            sides, [&](const glm::vec4& side) { return glm::dot(glm::vec3(side), place) + side.w < -radius; });
    }
    // Of how many pixels a mm is, for lengths across the line of sight, of an edge whose middle is at `depth`. One that
    // the eye is closer to than half its length is seen from there.
    [[nodiscard]] float pixels_at(float depth, float edge_length) const {
        return flat ? pixels : pixels / (depth > 0.5F * edge_length ? depth : 0.5F * edge_length);
    }
};
// Of a picture `height` pixels high.
[[nodiscard]] NearView near_view(const Camera& camera, const glm::dvec3& origin, const glm::dmat4& to_clip, int height);

} // namespace ramus::render
