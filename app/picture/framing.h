// Framing: keeps in view what a person sees of the vessels while their part of the picture gets another shape, because
// the picture is divided, a panel opens or the window changes. The view never turns; the eye moves away where the part
// becomes narrower. When the earlier shape returns and the camera has not been moved in between, so does the view.
#pragma once

#include "render/scene/camera.h"

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::app {

// The camera for a picture of size `to` that shows what `camera` shows in one of size `from`. Of `points` (mm, RAS: the
// farthest of what is in the picture) those that were between the left and the right side stay there. What was cut off
// may stay so. Without points, all of the width stays in view.
[[nodiscard]] render::Camera reframed(const render::Camera& camera, glm::ivec2 from, glm::ivec2 to,
                                      std::span<const glm::vec3> points);

class Framing {
public:
    using PointsSeen = std::function<std::vector<glm::vec3>(const render::Camera&, glm::ivec2 size)>;
    // To be called again and again with the current camera and size. Returns another camera where the size has changed
    // and the camera has not.
    [[nodiscard]] std::optional<render::Camera> follow(const render::Camera& camera, glm::ivec2 size,
                                                       const PointsSeen& points);
    void forget() { wanted_.reset(); } // the next camera is one that somebody has chosen

private:
    struct Wanted { // as chosen by a person or a command
        render::Camera camera;
        glm::ivec2 size;
    };
    std::optional<Wanted> wanted_;
    render::Camera camera_; // at the last call
    glm::ivec2 size_{0};
};

} // namespace ramus::app
