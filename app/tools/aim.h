// Aim: what a person points at, as a point in mm: what lies under the pointer, else the middle of what is visible. It
// is reckoned from the depths of the picture that was drawn last, so that nobody waits for it. What lies under the
// pointer stays known while the view turns about it, moves with it and comes nearer to it: it is the same point. Where
// the view has changed otherwise since the depths were read, the middle of what was visible stands in.
//
// The rules of the mouse: the view turns about what was under the pointer when the button went down, and about the
// middle of what is visible when that was nothing; it moves so that what was under the pointer stays there; the wheel
// and the right button come nearer to what is under the pointer, or to what is nearest to it in the picture.
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

    // What the last picture shows that has told its depths, a map for each viewport. Where the view has become `camera`
    // since, what is held on the way there stays.
    void see(std::vector<render::DepthMap> maps, const render::Camera& camera);
    // Where the pointer is: a viewport and a pixel of it; `reach` in pixels, that a thin vessel may be missed by.
    void point(std::size_t viewport, glm::dvec2 pixel, double reach);
    void point_nowhere();
    // The view became `camera` about what is under the pointer, which stays there; or moved with the pointer to
    // `pixel`.
    void carry(const render::Camera& camera);
    void carry(const render::Camera& camera, glm::dvec2 pixel);

    // None: nothing is in view.
    [[nodiscard]] std::optional<Target> target(const render::Camera& camera) const;
    // What the wheel comes nearer to.
    [[nodiscard]] std::optional<glm::dvec3> goal(const render::Camera& camera);
    // What the middle of the picture shows, or what is nearest to it there: what is zoomed to without a pointer. It is
    // the same point for a camera that has zoomed to it.
    [[nodiscard]] std::optional<glm::dvec3> in_middle(const render::Camera& camera);
    [[nodiscard]] const std::optional<render::Visible>& visible() const { return visible_; }
    // Whether a picture has been seen, and nothing was in it.
    [[nodiscard]] bool sees_nothing() const { return !maps_.empty() && !visible_; }

private:
    struct Spot {
        std::size_t viewport;
        glm::dvec2 pixel;
        double reach;
    };
    // A point that is under the pointer, or nearest to it, as `camera` looks.
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
    struct Middle { // what it was, and where in the picture
        glm::dvec3 at;
        glm::dvec2 pixel;
    };
    std::optional<Middle> middle_;
};

// How near the eye may come to a point of the surface, mm: a fraction of the vessel's radius there. `branch`: the one
// that is pointed at; none: what lies around the point, for it may not be known yet. `scene_mm`: how large all is, for
// what is no vessel.
[[nodiscard]] double least_distance_mm(const tree::VesselTree* tree, int branch, const glm::dvec3& at, double scene_mm);

} // namespace ramus::app
