// ScanPlane: a slice of a scan as a rectangle in space, sampled elsewhere. It is drawn as it is: without light, shadow,
// occlusion or fog, visible from both sides, and hides what is behind it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>

namespace ramus::render {

class LatePicture;

inline constexpr int kNoPlane = -1;

struct ScanPlane {
    // The picture's outer edges in mm (RAS): its corners are at `corner`, corner + right, corner + down and corner +
    // right + down.
    glm::dvec3 corner{0.0}, right{1.0, 0.0, 0.0}, down{0.0, 0.0, -1.0};
    // Rows from `corner` along `right`, then along `down`. Alpha 0: outside the scan, not drawn. Null: only the
    // outline. Frames compare the pointer: a changed slice is another picture.
    std::shared_ptr<const LatePicture> picture;
    glm::vec3 outline{0.9F};    // sRGB
    float outline_width = 0.0F; // points, around the rectangle; 0: none
    bool operator==(const ScanPlane&) const = default;
};

} // namespace ramus::render
