// Vessels that are one straight piece each, a branch each in order: their own surface, and the centerlines that they
// are cast along while the view moves.
#pragma once

#include "render/scene/centerlines.h"
#include "render/scene/frame.h"
#include "tests/support/tube_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>

namespace ramus::test {

struct StraightVessel {
    glm::vec3 from, to;
    float first, last; // radii
};

// Seen from the front, without overlays. `sides`: of the surface, around a vessel.
inline render::Frame frame_of(std::span<const StraightVessel> vessels, int sides, glm::ivec2 size, bool orthographic) {
    mesh::TriangleMesh mesh;
    auto lines = std::make_shared<render::Centerlines>();
    for (std::size_t i = 0; i < vessels.size(); ++i) {
        const StraightVessel& v = vessels[i];
        add_capsule(mesh, v.from, v.to, v.first, v.last, static_cast<int>(i), sides);
        lines->runs.push_back({static_cast<std::uint32_t>(lines->points.size()), 2});
        for (const auto& [place, radius] : {std::pair{v.from, v.first}, {v.to, v.last}}) {
            lines->points.emplace_back(place, glm::distance(place, v.from));
            lines->details.push_back({2.0F * radius, static_cast<std::int32_t>(i)});
        }
    }
    render::Frame frame;
    frame.mesh = std::make_shared<const render::PagedMesh>(mesh);
    frame.centerlines = lines;
    frame.beyond_ends = 1.0F; // as the capsules do
    frame.size = size;
    frame.camera = camera_for(frame.mesh->positions(), render::View::kAnterior, frame.size, orthographic);
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    frame.states.assign(vessels.size(), tree::BranchState::kNormal);
    return frame;
}

} // namespace ramus::test
