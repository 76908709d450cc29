// A tree's convolution surface before a camera, with the centerlines that it is cast along while the view moves.
#pragma once

#include "core/mesh/surface.h"
#include "core/tree/vessel_tree.h"
#include "render/scene/centerlines.h"
#include "render/scene/frame.h"

#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <glm/vec2.hpp>
#include <memory>

namespace ramus::test {

// Seen from the front, without overlays.
inline render::Frame surface_frame(const tree::VesselTree& tree, const mesh::SurfaceOptions& options, glm::ivec2 size) {
    Job job;
    auto surface = mesh::make_surface(tree, options, job);
    REQUIRE(surface);
    auto lines = std::make_shared<render::Centerlines>();
    for (std::size_t branch = 0; branch < tree.branches.size(); ++branch) {
        const auto& points = tree.branches[branch].points;
        lines->runs.push_back(
            {static_cast<std::uint32_t>(lines->points.size()), static_cast<std::uint32_t>(points.size())});
        for (const std::uint32_t point : points) {
            lines->points.emplace_back(tree.points[point].position, 0.0F);
            lines->details.push_back(
                {static_cast<float>(2.0 * tree.points[point].radius), static_cast<std::int32_t>(branch)});
        }
    }
    render::Frame frame;
    frame.mesh = std::make_shared<const render::PagedMesh>(surface->mesh);
    frame.centerlines = lines;
    frame.width = 5.0F;
    frame.size = size;
    frame.camera = camera_for(frame.mesh->positions(), render::View::kAnterior, frame.size, false);
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    frame.states.assign(tree.branches.size(), tree::BranchState::kNormal);
    return frame;
}

} // namespace ramus::test
