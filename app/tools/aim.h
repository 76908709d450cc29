// Aim: the 3D point (mm) that a person points at: what is under the pointer, otherwise the visible middle. It uses the
// depths of the last picture, so nothing waits. A point under the pointer stays valid while the view turns about it,
// moves with it or zooms to it. If the view changes otherwise, the middle of what was visible is used.
//
// Rules of the mouse: the view turns about the point under the pointer at the press, or about the visible middle.
// Panning keeps that point under the pointer. Wheel and right button zoom to the point under the pointer, or to the
// visible point nearest to it.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/depth_map.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::app {

class Aim {
public:
    enum class On { kPointer, kMiddle };
    struct Target {
        glm::dvec3 at{0.0};
        On on = On::kMiddle;
        bool operator==(const Target&) const = default;
    };

    // Takes the depths of the last picture, a map per viewport. If the view has become `camera` since, points held on
    // the way there stay valid.
    void see(std::vector<render::DepthMap> maps, const render::Camera& camera);
    // Sets the pointer: a viewport and a pixel in it; `reach`: pixels by which it may miss a thin vessel.
    void point(std::size_t viewport, glm::dvec2 pixel, double reach);
    void point_nowhere();
    // The view became `camera` by a move that keeps the point under the pointer; or that moved it along to `pixel`.
    void carry(const render::Camera& camera);
    void carry(const render::Camera& camera, glm::dvec2 pixel);

    // The point to turn about; none: nothing is in view.
    [[nodiscard]] std::optional<Target> target(const render::Camera& camera) const;
    // The point to zoom to.
    [[nodiscard]] std::optional<glm::dvec3> goal(const render::Camera& camera);
    // The point in the middle of the picture, or nearest to it, for zooming without a pointer. It stays the same for a
    // camera that has zoomed to it.
    [[nodiscard]] std::optional<glm::dvec3> in_middle(const render::Camera& camera);
    [[nodiscard]] const std::optional<render::Visible>& visible() const { return visible_; }
    // Whether the last picture was empty.
    [[nodiscard]] bool sees_nothing() const { return !maps_.empty() && !visible_; }

private:
    struct Spot {
        std::size_t viewport;
        glm::dvec2 pixel;
        double reach;
    };
    // A point under the pointer, or nearest to it, as seen by `camera`.
    struct Held {
        glm::dvec3 at;
        bool under;
        render::Camera camera;
    };
    void look_up();

    std::vector<render::DepthMap> maps_;
    std::optional<render::Visible> visible_;
    std::optional<Spot> spot_;
    std::optional<Held> held_;
    struct Middle { // the point in the middle, and its pixel
        glm::dvec3 at;
        glm::dvec2 pixel;
    };
    std::optional<Middle> middle_;
};

// The smallest distance of the eye from a surface point, mm: a fraction of the local radius. `branch`: the branch
// pointed at; kNoBranch: unknown, the branches around the point count. `scene_mm`: size of the scene, for points that
// are not on a vessel.
[[nodiscard]] double least_distance_mm(const tree::VesselTree* tree, int branch, const glm::dvec3& at, double scene_mm);

} // namespace ramus::app
