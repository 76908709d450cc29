// NearView: a view of a surface, for decisions that depend on sizes in the picture.
#pragma once

#include "render/scene/camera.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

// Positions are relative to the surface's origin.
struct NearView {
    glm::vec3 eye, forward;
    float pixels; // pixels per mm, in perspective at a depth of 1 mm
    bool flat;    // parallel projection
    glm::dmat4 to_clip;
    std::array<glm::vec4, 4> sides{}; // planes through the picture's sides, facing inward

    // Whether the picture may show part of the ball around `place`. Conservative.
    [[nodiscard]] bool shows(const glm::vec3& place, float radius) const {
        return std::ranges::none_of(
            sides, [&](const glm::vec4& side) { return glm::dot(glm::vec3(side), place) + side.w < -radius; });
    }
    // Pixels per mm across the line of sight, for an edge whose middle is at `depth`. The depth is at least half of the
    // edge's length, for edges close to the eye.
    [[nodiscard]] float pixels_at(float depth, float edge_length) const {
        return flat ? pixels : pixels / (depth > 0.5F * edge_length ? depth : 0.5F * edge_length);
    }
};
// `height`: of the picture in pixels.
[[nodiscard]] NearView near_view(const Camera& camera, const glm::dvec3& origin, const glm::dmat4& to_clip, int height);

} // namespace ramus::render
