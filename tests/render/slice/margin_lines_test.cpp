// Margins around lesions on slices: lines of equal distance, in the colours of the bands.
#include "core/mesh/sphere_mesh.h"
#include "render/slice/frame_section.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;

TEST_CASE("a slice has the margins of spheres and of meshes, and none of hidden lesions") {
    render::Frame frame;
    const glm::dvec3 ball(10.0, -5.0, 30.0);
    frame.lesions.spheres.emplace_back(ball, 6.0);
    frame.lesions.meshes.push_back(
        std::make_shared<const mesh::TriangleMesh>(mesh::sphere_mesh({60.0, 0.0, 30.0}, 5.0)));
    frame.lesions.looks = {{{1, 0, 0}, 0.6F}, {{1, 0, 0}, 0.6F}};
    const slice::Plane plane{{0.0, 0.0, 33.0}, {0.0, 0.0, 1.0}};
    render::FrameCutter cutter;
    const std::size_t outlines = cutter.section(frame, plane).lines.size();
    frame.margins.bands = {{5.0F, {1, 0, 0}}, {10.0F, {0, 1, 0}}};
    const render::FrameSection section = cutter.section(frame, plane);
    REQUIRE(section.lines.size() == outlines + 4);
    for (std::size_t n = outlines; n < section.lines.size(); ++n) {
        const render::SectionLine& line = section.lines[n];
        CHECK(line.closed);
        CHECK(line.fill == 0.0F);
        const double within = line.colour == glm::vec3(1, 0, 0) ? 5.0 : 10.0;
        const bool of_ball = line.points.front().x < 40.0;
        for (const glm::dvec3& at : line.points) {
            CHECK(at.z == doctest::Approx(33.0));
            const double distance =
                of_ball ? glm::distance(at, ball) - 6.0 : glm::distance(at, glm::dvec3(60.0, 0.0, 30.0)) - 5.0;
            CHECK(std::abs(distance - within) < 0.05);
        }
    }
    // A slice beyond the inner margin has the outer one alone.
    CHECK(cutter.section(frame, {{0.0, 0.0, 42.5}, {0.0, 0.0, 1.0}}).lines.size() == 2);
    CHECK(cutter.section(frame, {{0.0, 0.0, 90.0}, {0.0, 0.0, 1.0}}).lines.empty());
    frame.lesions.looks[0].opacity = 0.0F;
    CHECK(cutter.section(frame, plane).lines.size() == 3);
}
