// DepthMap: depths of the visible vessels, lesions and solid context, read back from a picture at half resolution. It
// finds the point under a pixel, the nearest visible point and the visible middle without GL. Pixels refer to its own
// camera; points in mm are valid for every camera.
#pragma once

#include "render/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::render {

struct DepthMap {
    static constexpr float kEmpty = 1e30F; // as in shaders/view.glsl

    Camera camera;
    glm::ivec2 picture{0};     // pixels of the picture
    glm::ivec2 size{0};        // of the map, about half of `picture`
    std::vector<float> depths; // mm along the line of sight, rows from below; kEmpty: nothing

    // Size of the map for a picture of this size.
    [[nodiscard]] static glm::ivec2 size_for(glm::ivec2 picture);

    // The visible point at a pixel, or the one nearest to it within `reach` pixels; none if nothing is there. Pixels
    // from the top left, as for project().
    [[nodiscard]] std::optional<glm::dvec3> point_at(glm::dvec2 pixel, double reach) const;
    // The visible point nearest to the pixel, at any distance; none in an empty picture.
    [[nodiscard]] std::optional<glm::dvec3> nearest_point(glm::dvec2 pixel) const;

private:
    [[nodiscard]] glm::dvec2 pixel_of(int x, int y) const; // middle of an entry
    [[nodiscard]] std::optional<glm::dvec3> nearest_in(glm::ivec2 from, glm::ivec2 to, glm::dvec2 pixel,
                                                       double reach) const;
};

// Extent of what one or several pictures show: the middle of its box in the camera's axes, and half of the box's depth.
// The box omits the nearest and the farthest fiftieth in each direction.
struct Visible {
    glm::dvec3 middle{0.0};
    double half_depth_mm = 0.0;
    bool operator==(const Visible&) const = default;
};
// All maps must have the same camera and size. None if all are empty.
[[nodiscard]] std::optional<Visible> visible_in(std::span<const DepthMap> maps);

} // namespace ramus::render
