// A tube along x of 5 mm radius and what may be beside it, seen from the front without perspective, 0.1 mm a pixel; and
// what clear surfaces make of a pixel, reckoned by hand.
#pragma once

#include "render/renderer/renderer.h"
#include "render/scene/colour.h"
#include "tests/support/gl_test.h"
#include "tests/support/icosphere.h"
#include "tests/support/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <memory>

namespace ramus::test {

inline constexpr double kPixelMm = 0.1, kTube = 5.0, kSphere = 12.0;
inline constexpr glm::vec3 kColour{0.85F, 0.55F, 0.35F};

struct BesideScene {
    WatchedContext context;
    std::unique_ptr<render::Renderer> renderer = render::Renderer::create().value();
    render::Frame frame;

    explicit BesideScene(render::GlVersion newest = {99, 0}) : context(newest) {
        mesh::TriangleMesh mesh;
        add_capsule(mesh, {-20, 0, 0}, {20, 0, 0}, float(kTube), float(kTube), 0, 96);
        frame.mesh = std::make_shared<const render::PagedMesh>(mesh);
        frame.size = {600, 300};
        frame.camera = render::looking(render::Camera{}, render::View::kAnterior);
        frame.camera.focal_point = {0, 0, 0};
        frame.camera.position = {0, 200, 0};
        frame.camera.orthographic = true;
        frame.camera.scale = 0.5 * kPixelMm * frame.size.y;
        frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
        frame.appearance.depth_cue = 0.0F;
        frame.states.assign(1, tree::BranchState::kNormal);
    }
    ~BesideScene() { renderer.reset(); }
    void add_sphere(float opacity, glm::dvec3 centre = glm::dvec3(0.0), double radius = kSphere) {
        frame.context.push_back({std::make_shared<const mesh::TriangleMesh>(icosphere(6, centre, radius)), nullptr,
                                 kColour, opacity, false});
    }
    render::DrawStatistics draw() {
        const auto done = renderer->draw(frame);
        REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
        return *done;
    }
    render::Image picture() {
        (void)draw();
        return renderer->read_image();
    }
    // The pixel of a place; the patient's right is at the left.
    [[nodiscard]] glm::ivec2 at(double x, double z) const {
        const glm::dvec3 seen = *render::project(frame.camera, frame.size, {x, 0.0, z});
        return {int(std::floor(seen.x)), int(std::floor(seen.y))};
    }
    [[nodiscard]] const std::uint8_t* colour(const render::Image& image, double x, double z) const {
        const glm::ivec2 p = at(x, z);
        return image.pixel(p.x, p.y);
    }
    [[nodiscard]] render::Pick pick(double x, double z) const {
        const glm::ivec2 p = at(x, z);
        return renderer->pick(p.x + 0.5, p.y + 0.5);
    }
};

inline int apart(const std::uint8_t* a, const std::uint8_t* b) {
    int most = 0;
    for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

// What shaders/look.glsl adds against banding, of a byte.
inline double half_step(int x, int y, int height) {
    const glm::vec2 at(float(height - 1 - y) + 0.5F + 17.0F, float(x) + 0.5F + 17.0F);
    const float turned = glm::dot(at, glm::vec2(0.06711056F, 0.00583715F));
    const float noise = 52.9829189F * (turned - std::floor(turned));
    return double(noise - std::floor(noise)) - 0.5;
}

// As shaders/look.glsl encodes, and back.
inline double encoded(double c) {
    if (c >= 0.72) c = 0.72 + 0.28 * (1.0 - std::exp(-(c - 0.72) / 0.28));
    return 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055);
}
inline double decoded(double byte) {
    const double c = render::linear(float(byte / 255.0));
    return c < 0.72 ? c : 0.72 - 0.28 * std::log(1.0 - (std::min(c, 0.999) - 0.72) / 0.28);
}

// The glass of a context mesh as shaders/look/glass.glsl computes it, without depth cue, the eye being infinitely far:
// premultiplied.
inline glm::dvec4 veil_of(const glm::vec3& colour, double opacity, const glm::dvec3& normal) {
    const glm::dvec3 key(-0.429, 0.572, 0.699), fill(0.772, -0.051, 0.634), eye(0, 0, 1);
    const double veil = 1.0 - std::pow(1.0 - opacity, 1.0 / (0.14 + 0.86 * std::max(0.0, normal.z)));
    const glm::dvec3 light =
        glm::dvec3(render::linear(colour, 0.0F)) *
        (0.45 + 0.85 * std::max(0.0, glm::dot(normal, key)) + 0.15 * std::max(0.0, glm::dot(normal, fill)));
    const double shine = 0.22 * opacity * std::pow(std::max(0.0, glm::dot(normal, glm::normalize(key + eye))), 60.0);
    return {light * veil + shine, std::min(1.0, veil + shine)};
}

} // namespace ramus::test
