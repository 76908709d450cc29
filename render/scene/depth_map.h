// DepthMap: how far away what a picture shows is, place by place, as it was read back of the picture: the nearest thing
// that can be pointed at, of vessels, lesions and solid context. It answers what lies under a pixel, which thing is
// nearest to it, and where the middle of all that is seen is, without GL and without waiting for it. What it says holds
// for its own camera; points in mm that came of it hold for every one.
#pragma once

#include "render/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::render {

struct DepthMap {
    static constexpr float kEmpty = 1e30F; // as shaders/view.glsl has it

    Camera camera;
    glm::ivec2 picture{0};     // pixels of the picture
    glm::ivec2 size{0};        // of the map, about half as many each way
    std::vector<float> depths; // mm along the line of sight, rows from below; kEmpty: nothing

    // Of a picture of so many pixels.
    [[nodiscard]] static glm::ivec2 size_for(glm::ivec2 picture);

    // The point seen at a pixel, or the nearest to it within `reach` pixels; nothing where nothing is. Pixels as of
    // project(), from the top left.
    [[nodiscard]] std::optional<glm::dvec3> point_at(glm::dvec2 pixel, double reach) const;
    // The point that is nearest to the pixel in the picture, however far; nothing in an empty picture.
    [[nodiscard]] std::optional<glm::dvec3> nearest_point(glm::dvec2 pixel) const;

private:
    [[nodiscard]] glm::dvec2 pixel_of(int x, int y) const; // the middle of a place
    [[nodiscard]] std::optional<glm::dvec3> nearest_in(glm::ivec2 from, glm::ivec2 to, glm::dvec2 pixel,
                                                       double reach) const;
};

// What pictures show, all together: the middle of the box of what is seen, across, up and into the picture, and half of
// that box's depth. Left out of the box are the nearest and the farthest fiftieth of the places, each way.
struct Visible {
    glm::dvec3 middle{0.0};
    double half_depth_mm = 0.0;
    bool operator==(const Visible&) const = default;
};
// All maps are of one camera and one size; nothing where all are empty.
[[nodiscard]] std::optional<Visible> visible_in(std::span<const DepthMap> maps);

} // namespace ramus::render
