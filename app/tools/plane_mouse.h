// PlaneMouse: the mouse at the edges of slices that are drawn as planes among the vessels. A drag at an edge moves the
// plane along its normal, such that the place that was grabbed stays under the pointer. Pixels count from the top left
// of the vessels' part of the picture; places are in mm (RAS). No window.
#pragma once

#include "app/session/slices.h"
#include "core/base/bounds.h"
#include "render/scene/camera.h"
#include "render/scene/scan_plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::app {

// The view that the planes are seen in.
struct PlaneSight {
    const render::Camera& camera;
    glm::ivec2 size{1};
    float pixel_ratio = 1.0F;
};

// The slice of each plane of a picture, in the order of PlanePictures::planes().
[[nodiscard]] std::vector<slice::Direction> slices_among_vessels(const SliceViews& views);

struct PlaneEdge {
    std::size_t plane = 0;  // index of the plane
    glm::dvec3 place{0.0};  // on its edge, nearest to the pointer
    glm::dvec3 normal{0.0}; // of the plane, of unit length
};
// The edge at a pixel, or within a few points of it.
[[nodiscard]] std::optional<PlaneEdge> edge_under(std::span<const render::ScanPlane> planes, const PlaneSight& sight,
                                                  glm::dvec2 at);
// The outline of a plane in pixels, without what is behind the eye.
[[nodiscard]] std::vector<glm::dvec2> outline_of(const render::ScanPlane& plane, const PlaneSight& sight);

// How far along `normal` a place goes that follows the pointer from one pixel to another, mm. A plane that is seen from
// its front moves towards the viewer when the pointer moves down.
[[nodiscard]] double slid_mm(const glm::dvec3& place, const glm::dvec3& normal, const PlaneSight& sight,
                             glm::dvec2 from, glm::dvec2 to);

class PlaneMouse {
public:
    // `crosshair`: where the slices cross.
    void grab(const PlaneEdge& edge, slice::Direction direction, const glm::dvec3& crosshair, glm::dvec2 at);
    // The crosshair after a move of the pointer; the same as at the press until that is a drag. `bounds`: of the scan,
    // which the plane does not leave.
    [[nodiscard]] glm::dvec3 move(const PlaneSight& sight, const Bounds<glm::dvec3>& bounds, glm::dvec2 to);
    void release() { held_.reset(); }
    [[nodiscard]] bool held() const { return held_.has_value(); }
    [[nodiscard]] bool dragging() const { return held_ && held_->dragged; }
    [[nodiscard]] slice::Direction direction() const { return held_->direction; } // only while held

private:
    struct Held {
        PlaneEdge edge;
        slice::Direction direction;
        glm::dvec3 crosshair;
        glm::dvec2 at;
        bool dragged = false;
    };
    std::optional<Held> held_;
};

} // namespace ramus::app
