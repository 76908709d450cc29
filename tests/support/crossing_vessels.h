// Forty vessels that cross each other, and a renderer for them: enough triangles for pictures that take several parts.
#pragma once

#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <doctest/doctest.h>
#include <memory>

namespace ramus::test {

struct CrossingVessels {
    static constexpr int kVessels = 40;

    WatchedContext context;
    std::unique_ptr<render::Renderer> renderer = render::Renderer::create().value();
    render::Frame frame;

    // `sides`: around each vessel.
    explicit CrossingVessels(render::GlVersion newest, int sides) : context(newest) {
        mesh::TriangleMesh mesh;
        for (int i = 0; i < kVessels; ++i) {
            const auto at = static_cast<float>(i);
            add_capsule(mesh, {-30.0F, at - 20.0F, 0.3F * at}, {30.0F, 20.0F - at, -0.2F * at}, 1.5F, 0.8F, i, sides);
        }
        frame.mesh = std::make_shared<const render::PagedMesh>(mesh);
        frame.size = {320, 240};
        frame.camera = camera_for(frame.mesh->positions(), render::View::kAnterior, frame.size, false);
        frame.states.assign(kVessels, tree::BranchState::kNormal);
    }
    [[nodiscard]] render::DrawStatistics draw(const render::Frame& of, double seconds = render::kUntilDone) const {
        const auto done = renderer->draw(of, render::kUploadAll, seconds);
        REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
        return *done;
    }
};

// Every third vessel, with a lesion in the middle.
inline render::Frame with_glass(render::Frame frame) {
    for (std::size_t i = 0; i < frame.states.size(); i += 3) frame.states[i] = tree::BranchState::kDefocused;
    frame.lesions.spheres = {{0.0, 0.0, 0.0, 6.0}};
    return frame;
}

} // namespace ramus::test
