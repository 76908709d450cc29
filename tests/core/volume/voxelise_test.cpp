// Masks made of trees.
#include "core/tree/build_tree.h"
#include "core/volume/voxelise.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/vec4.hpp>
#include <numbers>

using namespace ramus;

namespace {

tree::VesselTree vessel(double length, double first, double last) {
    return tree::assemble({{{1.0, 2.0, 3.0}, first}, {{1.0 + length, 2.0, 3.0}, last}}, {}, {{{0, 1}}}, {0});
}

} // namespace

TEST_CASE("a vessel's voxels are as many as its volume has") {
    const auto made = volume::voxelised(vessel(40.0, 4.0, 2.0), 0.25);
    REQUIRE(made);
    // A cone of that length, and a ball in two halves; radii are taken across the axis.
    const double pi = std::numbers::pi;
    const double expected = pi * 40.0 * (16.0 + 8.0 + 4.0) / 3.0 + 2.0 / 3.0 * pi * (64.0 + 8.0);
    CHECK(double(made->mask.count()) * std::pow(0.25, 3) == doctest::Approx(expected).epsilon(0.01));
    // Where the vessel is, and nothing at the border.
    const glm::dvec4 at = glm::inverse(made->to_patient) * glm::dvec4(21.0, 2.0, 3.0, 1.0);
    CHECK(made->mask.test(glm::ivec3(std::lround(at.x), std::lround(at.y), std::lround(at.z))));
    const glm::ivec3 size = made->mask.size();
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i)
            CHECK_FALSE((made->mask.test({i, j, 0}) || made->mask.test({i, j, size.z - 1})));
}

TEST_CASE("voxels that cannot be are refused") {
    CHECK_FALSE(volume::voxelised(vessel(40.0, 4.0, 2.0), 0.0));
    CHECK_FALSE(volume::voxelised(vessel(40.0, 4.0, 2.0), std::nan("")));
    CHECK_FALSE(volume::voxelised(vessel(40.0, 4.0, 2.0), 1e-7));
    Job job;
    CHECK_FALSE(volume::voxelised(vessel(40.0, 4.0, 2.0), 0.25, 1000.0, job));
    job.cancel();
    CHECK(volume::voxelised(vessel(40.0, 4.0, 2.0), 0.25, 0.0, job).error().what == "cancelled");
    tree::VesselTree far = vessel(40.0, 4.0, 2.0);
    for (tree::Point& point : far.points) point.position.x += 9.9e6; // in steps of 1 mm
    const auto coarse = volume::voxelised(far, 0.25);
    REQUIRE_FALSE(coarse);
    CHECK(coarse.error().what.find("single precision") != std::string::npos);
    CHECK(volume::sensible_voxel_mm(vessel(40.0, 4.0, 2.0)) == doctest::Approx(2.0));
}
