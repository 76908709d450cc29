// A small tree of capsules, and a renderer for it.
#pragma once

#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <doctest/doctest.h>
#include <memory>

namespace ramus::test {

// A trunk along z (branch 0), an arm to the patient's left (1) and one to the right and front (2), a twig across before
// the trunk (3); mm.
inline std::shared_ptr<const render::PagedMesh> small_tree_mesh() {
    mesh::TriangleMesh mesh;
    add_capsule(mesh, {0, 0, -30}, {0, 0, 10}, 5.0F, 4.0F, 0);
    add_capsule(mesh, {0, 0, 10}, {-25, 0, 30}, 3.5F, 2.0F, 1);
    add_capsule(mesh, {0, 0, 10}, {22, 10, 28}, 3.0F, 1.5F, 2);
    add_capsule(mesh, {-20, 12, -14}, {20, 12, -10}, 1.0F, 1.0F, 3);
    return std::make_shared<const render::PagedMesh>(mesh);
}

// Drawn as a picture without overlays.
struct SmallTree {
    WatchedContext context;
    std::unique_ptr<render::Renderer> renderer = render::Renderer::create().value();
    render::Frame frame;

    explicit SmallTree(glm::ivec2 size = {400, 300}) {
        frame.mesh = small_tree_mesh();
        frame.size = size;
        frame.camera = render::camera_for(frame.mesh->positions(), render::View::kAnterior, size);
        frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
        frame.states.assign(4, tree::BranchState::kNormal);
    }
    ~SmallTree() { renderer.reset(); }
    render::Image draw() {
        const auto done = renderer->draw(frame);
        REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
        return renderer->read_image();
    }
    // Pixels around which only `branch` (or nothing, kNoBranch) is seen, by projecting its own surface.
    [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec3& point) const {
        return glm::dvec2(*render::project(frame.camera, frame.size, point));
    }
};

} // namespace ramus::test
