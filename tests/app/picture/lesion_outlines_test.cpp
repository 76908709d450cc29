// Outlines of lesions within context: where a ball ends in the picture, told by the camera alone.
#include "app/assets/assets.h"
#include "app/picture/lesion_outlines.h"
#include "tests/support/icosphere.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

render::Frame frame_with(bool orthographic) {
    render::Frame frame;
    frame.size = {800, 600};
    frame.camera.position = {30, 200, 20};
    frame.camera.focal_point = {0, 0, 0};
    frame.camera.scale = 60.0;
    frame.camera.orthographic = orthographic;
    frame.context.push_back(
        {std::make_shared<const mesh::TriangleMesh>(test::icosphere(3, glm::dvec3(0.0), 50.0)), nullptr});
    return frame;
}

// Of all directions, how far the outline reaches away from the ball's middle in the picture, least and most.
std::pair<double, double> reach(const render::Frame& frame, const std::vector<glm::dvec3>& line,
                                const glm::dvec3& middle) {
    const glm::dvec2 at(*render::project(frame.camera, frame.size, middle));
    double least = 1e9, most = 0.0;
    for (const glm::dvec3& place : line) {
        const double away = glm::distance(glm::dvec2(*render::project(frame.camera, frame.size, place)), at);
        least = std::min(least, away), most = std::max(most, away);
    }
    return {least, most};
}

} // namespace

TEST_CASE("lesions have an outline while transparent context is shown, and none otherwise") {
    for (const bool orthographic : {true, false}) {
        CAPTURE(orthographic);
        render::Frame frame = frame_with(orthographic);
        const glm::dvec3 middle(3, 2, 5);
        frame.lesions.spheres = {{middle, 10.0}};
        outline_lesions(frame, Assets(), Marks());
        REQUIRE(frame.lines.size() == 1);
        // All of the outline touches the ball, and sight only grazes it there.
        const glm::dvec3 forward = render::axes_of(frame.camera).forward;
        for (const glm::dvec3& place : frame.lines[0].points) {
            const glm::dvec3 sight = orthographic ? forward : glm::normalize(place - frame.camera.position);
            CHECK(glm::distance(place, middle) == doctest::Approx(10.0));
            CHECK(std::abs(glm::dot(sight, place - middle)) < 1e-6);
        }
        for (const float opacity : {0.0F, 1.0F}) { // nothing, and solid
            render::Frame other = frame_with(orthographic);
            other.lesions = frame.lesions;
            other.context[0].opacity = opacity;
            outline_lesions(other, Assets(), Marks());
            CHECK(other.lines.empty());
        }
        render::Frame within = frame_with(false);
        within.camera.position = middle;
        within.lesions = frame.lesions;
        outline_lesions(within, Assets(), Marks());
        CHECK(within.lines.empty());
    }
}

TEST_CASE("the outline of a mesh in the picture is one closed line for each of its parts") {
    for (const bool orthographic : {true, false}) {
        CAPTURE(orthographic);
        render::Frame frame = frame_with(orthographic);
        const glm::dvec3 middle(3, 2, 5), side(-22, 0, 5);
        mesh::TriangleMesh ball = test::icosphere(4, middle, 10.0);
        frame.lesions.spheres = {{middle, 10.0}};
        outline_lesions(frame, Assets(), Marks());
        const auto [least, most] = reach(frame, frame.lines.at(0).points, middle);
        auto lines = silhouette(ball, middle, frame.camera, frame.size);
        REQUIRE(lines.size() == 1);
        const auto [nearest, farthest] = reach(frame, lines[0], middle);
        CHECK(nearest > least - 2.5);
        CHECK(farthest < most + 2.5);
        const mesh::TriangleMesh other = test::icosphere(4, side, 10.0);
        const auto first = static_cast<std::uint32_t>(ball.positions.size());
        ball.positions.insert(ball.positions.end(), other.positions.begin(), other.positions.end());
        for (const glm::uvec3& t : other.triangles) ball.triangles.push_back(t + first);
        CHECK(silhouette(ball, 0.5 * (middle + side), frame.camera, frame.size).size() == 2);
        frame.camera.position = frame.camera.focal_point = middle;
        frame.camera.position.y += 1.0;
        if (!orthographic) CHECK(silhouette(ball, middle, frame.camera, frame.size).empty());
    }
}
