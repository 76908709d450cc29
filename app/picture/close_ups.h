// Places of a tree that are worth a picture of their own, and cameras that look at them: for the pictures of studies.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/renderer/renderer.h"
#include "render/scene/camera.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::app {

inline constexpr std::size_t kCloseUps = 3;

struct CloseUp {
    glm::dvec3 position{0.0};
    double radius = 0.0; // of the vessel
};

// Where vessels branch, the widest first; the middles of branches where nothing does.
[[nodiscard]] std::vector<CloseUp> close_ups_of(const tree::VesselTree& tree);

// Of the widest, the middling and the thin ones one each, of those that can be seen in the picture that is drawn.
[[nodiscard]] std::vector<CloseUp> choose_close_ups(render::Renderer& renderer, const render::Frame& drawn,
                                                    const std::vector<CloseUp>& all);

// `camera`, which sees the whole tree, from the same side close to the place.
[[nodiscard]] render::Camera close_to(const CloseUp& close_up, render::Camera camera);

} // namespace ramus::app
