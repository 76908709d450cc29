// What passes are told about a view, against the camera's own projection. Without GL.
#include "render/renderer/view_setup.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus::render;

namespace {

ViewSetup looking_at(const Frame& frame, const Box& box, int shift) {
    ViewSetup view;
    view.picture = view.size = frame.size;
    view.samples = 4;
    view.shift = shift;
    view.look(frame, box, {{{40.0, 0.0, 0.0}, 5.0}});
    return view;
}

// As eye_depth() of view.glsl.
double eye_depth(const ViewBlock& block, double value) {
    return block.picture.w > 0.5F ? (value - block.clip_to_eye.z) * block.clip_to_eye.y
                                  : block.clip_to_eye.z / (value + block.clip_to_eye.y);
}

} // namespace

TEST_CASE("from a pixel and its depth passes find the point that the camera sees there") {
    Frame frame;
    frame.size = {400, 300};
    Box box;
    box.lower = box.upper = glm::dvec3(-20.0);
    box.include({20.0, 20.0, 20.0});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
    for (const bool orthographic : {false, true})
        for (int shift = 0; shift < kFineViews; ++shift) {
            CAPTURE(orthographic);
            CAPTURE(shift);
            frame.camera = turned(camera_for(box, View::kAnterior, frame.size, orthographic), 30.0, 20.0);
            const ViewSetup view = looking_at(frame, box, shift);
            for (int i = 0; i < 50; ++i) {
                const glm::dvec3 point(coordinate(random), coordinate(random), coordinate(random));
                const glm::dvec4 clip = view.to_clip * glm::dvec4(point, 1.0);
                const glm::dvec3 at = glm::dvec3(clip) / clip.w;
                CHECK(at.z > 0.0); // between the planes, and nearer is larger
                CHECK(at.z < 1.0);
                const glm::dvec2 pixel = 0.5 * (glm::dvec2(at) + 1.0) * glm::dvec2(frame.size);
                const glm::dvec3 seen = *project(frame.camera, frame.size, point);
                const glm::dvec2 off = pixel - glm::dvec2(seen.x, frame.size.y - seen.y);
                CHECK(glm::length(off) < 0.25);
                CHECK((shift != 0 || glm::length(off) < 1e-6));

                const glm::dvec3 eye = eye_matrix(frame.camera) * glm::dvec4(point, 1.0);
                const double depth = eye_depth(view.block, at.z);
                const glm::dvec2 xy = (pixel - glm::dvec2(view.block.pixel_to_eye)) *
                                      double(view.block.pixel_to_eye.z) * (orthographic ? 1.0 : depth);
                CHECK(depth == doctest::Approx(eye.z).epsilon(1e-4));
                CHECK(glm::distance(xy, glm::dvec2(eye)) < 1e-2);
            }
        }
}

TEST_CASE("the near plane is nearer than what is looked at, however close") {
    Box box; // 200 mm of tree around the eye
    box.lower = box.upper = glm::dvec3(-100.0);
    box.include({100.0, 100.0, 100.0});
    Frame frame;
    frame.camera.view_up = {0.0, 0.0, 1.0};
    frame.camera.position = {0.0, 0.0, 0.0};
    for (const double away : {10.0, 0.5, 0.02, 0.002}) {
        CAPTURE(away);
        frame.camera.focal_point = {0.0, -away, 0.0};
        const ViewSetup view = looking_at(frame, box, 0);
        for (const double at : {0.1 * away, away, 90.0}) {
            const glm::dvec4 clip = view.to_clip * glm::dvec4(0.0, -at, 0.0, 1.0);
            CHECK(clip.z > 0.0);
            CHECK(clip.z < clip.w);
            CHECK(eye_depth(view.block, static_cast<float>(clip.z / clip.w)) == doctest::Approx(at).epsilon(1e-3));
        }
    }
}

TEST_CASE("the planes enclose what is beside the tree as well") {
    Box box;
    box.lower = box.upper = glm::dvec3(-1.0);
    box.include({1.0, 1.0, 1.0});
    Frame frame;
    frame.camera = camera_for(box, View::kRight, frame.size, true); // along x
    const ViewSetup view = looking_at(frame, box, 0);
    for (const double x : {-1.0, 1.0, 35.0, 45.0}) { // the tree's box, and the ball beside it
        const glm::dvec4 clip = view.to_clip * glm::dvec4(x, 0.0, 0.0, 1.0);
        CHECK(clip.z > 0.0);
        CHECK(clip.z < clip.w);
    }
}
