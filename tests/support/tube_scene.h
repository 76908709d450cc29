// A frame of one tube, and its picture.
#pragma once

#include "render/renderer/renderer.h"
#include "tests/support/tube_mesh.h"

#include <doctest/doctest.h>
#include <memory>

namespace ramus::test {

// A tube along x, seen from the front without perspective, 0.1 mm a pixel.
inline render::Frame tube(float radius, glm::ivec2 size = {300, 200}) {
    mesh::TriangleMesh mesh;
    add_capsule(mesh, {-12, 0, 0}, {12, 0, 0}, radius, radius, 0, 96);
    render::Frame frame;
    frame.mesh = std::make_shared<const render::PagedMesh>(mesh);
    frame.size = size;
    frame.camera = looking(render::Camera{}, render::View::kAnterior);
    frame.camera.focal_point = {0, 0, 0};
    frame.camera.position = {0, 200, 0};
    frame.camera.orthographic = true;
    frame.camera.scale = 0.05 * size.y;
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    auto lines = std::make_shared<render::Centerlines>();
    lines->runs = {{0, 7}};
    for (int i = 0; i < 7; ++i) {
        lines->points.emplace_back(-12.0F + 4.0F * float(i), 0.0F, 0.0F, 4.0F * float(i));
        lines->details.push_back({2.0F * radius, 0});
    }
    frame.centerlines = lines;
    return frame;
}

inline render::Image drawn(render::Renderer& renderer, const render::Frame& frame) {
    REQUIRE(renderer.draw(frame));
    return renderer.read_image();
}

} // namespace ramus::test
