#include "core/volume/isosurface.h"
#include "tests/support/mask.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>
#include <vector>

using namespace ramus;
using mesh::TriangleMesh;
using volume::VoxelSteps;

namespace {

TriangleMesh surface_of_mask(const volume::BitMask& mask, const glm::dmat4& to_patient, VoxelSteps steps,
                             int threads = 0) {
    Job job;
    volume::IsosurfaceOptions options;
    options.steps = steps;
    options.threads = threads;
    return volume::mask_surface(mask, to_patient, options, job).value();
}

// An ellipsoid in slices that are four times as thick as their pixels are wide, turned and moved in space.
struct ThickSlices {
    glm::dvec3 spacing{1, 1, 4}, axes{40, 35, 30}, middle{42.13, 37.27, 34.31}; // mm, of the volume
    glm::ivec3 size{85, 75, 18};
    glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), {40.0, -7.0, 12.0}), 0.7, {1.0, 2.0, -1.0});
    glm::dmat4 to_patient = turned * test::voxels_of(spacing);
    volume::BitMask mask = test::mask_of(
        size, [&](const glm::ivec3& v) { return glm::length((glm::dvec3(v) * spacing - middle) / axes) < 1.0; });
    glm::dmat4 back = glm::inverse(turned);

    struct Errors {
        double distance_mm = 0.0,
               angle_95 = 0.0; // mean, and so that 95 % of the vertices have no larger one, in degrees
        double period = 0.0;   // by how much more normals lean to the slices' at the middle between slices than on them
    };
    [[nodiscard]] Errors errors(const TriangleMesh& mesh, const TriangleMesh& exact) const {
        Errors found;
        std::vector<double> angles;
        glm::dvec2 lean(0.0), counts(0.0); // of vertices within slices, and between them
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 at = glm::dvec3(back * glm::dvec4(glm::dvec3(mesh.positions[v]), 1.0)) - middle;
            const glm::dvec3 normal = glm::dmat3(back) * glm::dvec3(mesh.normals[v]);
            // To first order: the ellipsoid's function over its gradient.
            const glm::dvec3 gradient = at / (axes * axes);
            found.distance_mm +=
                std::abs(glm::dot(at, gradient) - 1.0) / (2.0 * glm::length(gradient) * double(mesh.positions.size()));
            const glm::dvec3 ideal = glm::normalize(gradient);
            angles.push_back(std::acos(std::clamp(glm::dot(normal, ideal), -1.0, 1.0)) * 180.0 / std::numbers::pi);
            const double slice = (back * glm::dvec4(glm::dvec3(exact.positions[v]), 1.0)).z / spacing.z;
            const int between = std::abs(slice - std::round(slice)) > 0.25 ? 1 : 0;
            lean[between] += std::abs(normal.z) - std::abs(ideal.z);
            counts[between] += 1.0;
        }
        std::ranges::sort(angles);
        found.angle_95 = angles[angles.size() * 95 / 100];
        found.period = std::abs(lean.x / counts.x - lean.y / counts.y);
        return found;
    }
};

// How far each vertex has moved along each axis, in voxels.
std::vector<glm::dvec3> moves(const TriangleMesh& from, const TriangleMesh& to, const glm::dmat4& to_patient) {
    const glm::dmat3 to_voxels(glm::inverse(to_patient));
    std::vector<glm::dvec3> all;
    for (std::size_t v = 0; v < from.positions.size(); ++v)
        all.push_back(to_voxels * glm::dvec3(to.positions[v] - from.positions[v]));
    return all;
}

} // namespace

TEST_CASE("without steps the surface of a mask stays within half a voxel of the voxels' and has no slices") {
    const ThickSlices scan;
    const TriangleMesh exact = surface_of_mask(scan.mask, scan.to_patient, VoxelSteps::kKept);
    const TriangleMesh smooth = surface_of_mask(scan.mask, scan.to_patient, VoxelSteps::kSmoothed);
    REQUIRE(smooth.positions.size() == exact.positions.size());
    CHECK(smooth.triangles == exact.triangles);
    for (const glm::dvec3& move : moves(exact, smooth, scan.to_patient)) {
        const glm::dvec3 part = glm::abs(move);
        const double most = std::max({part.x, part.y, part.z});
        CHECK(most < 0.5);
        CHECK(part.x + part.y + part.z == doctest::Approx(most).epsilon(1e-3)); // along one axis
    }
    const auto before = scan.errors(exact, exact), after = scan.errors(smooth, exact);
    MESSAGE("off by ", before.distance_mm, " mm, ", before.angle_95, " degrees, period ", before.period,
            "; without steps ", after.distance_mm, " mm, ", after.angle_95, " degrees, period ", after.period);
    // What is between two slices, 4 mm apart, is known to half a pixel at each terrace's edges.
    CHECK(after.distance_mm < 0.25 * before.distance_mm);
    CHECK(after.angle_95 < 0.2 * before.angle_95);
    CHECK(after.period < 0.1 * before.period);
}

TEST_CASE("a smooth surface has the same bits for any number of threads") {
    const ThickSlices scan;
    CHECK(surface_of_mask(scan.mask, scan.to_patient, VoxelSteps::kSmoothed, 1) ==
          surface_of_mask(scan.mask, scan.to_patient, VoxelSteps::kSmoothed, 2));
}

TEST_CASE("a smooth surface keeps the width of what is a voxel thin") {
    // A rod, a gap between two blocks, and a sheet of one slice.
    const auto mask = test::mask_of({40, 40, 24}, [](const glm::ivec3& v) {
        const bool rod = v.y == 4 && v.z == 2 && v.x > 3 && v.x < 36;
        const bool blocks = v.y > 10 && v.y < 25 && v.y != 17 && v.x > 3 && v.x < 36 && v.z > 1 && v.z < 22;
        const bool sheet = v.z == 5 && v.y > 29 && v.y < 38 && v.x > 3 && v.x < 36;
        return rod || blocks || sheet;
    });
    for (const double thickness : {1.0, 4.0}) {
        CAPTURE(thickness);
        const glm::dmat4 to_patient = test::voxels_of({1, 1, thickness});
        const TriangleMesh exact = surface_of_mask(mask, to_patient, VoxelSteps::kKept);
        const auto moved = moves(exact, surface_of_mask(mask, to_patient, VoxelSteps::kSmoothed), to_patient);
        int compared = 0;
        for (std::size_t v = 0; v < moved.size(); ++v) {
            const glm::dvec3 at = glm::dvec3(exact.positions[v]) / glm::dvec3(1, 1, thickness);
            const bool amid = at.x > 15.0 && at.x < 25.0;
            const bool rod = at.y < 6.0 && at.y != 4.0; // its width within slices
            const bool gap = at.y > 16.0 && at.y < 18.0 && at.z > 9.0 && at.z < 14.0;
            const bool sheet = at.y > 32.0 && at.y < 35.0;
            if (!amid || !(rod || gap || sheet)) continue;
            ++compared;
            CHECK(glm::length(moved[v]) < 0.25); // from both sides: at least half of its width is left
        }
        CHECK(compared > 100);
    }
}

TEST_CASE("a smooth surface of nothing has no triangles, and of a full volume is closed at its border") {
    CHECK(surface_of_mask(volume::BitMask({5, 5, 5}), glm::dmat4(1.0), VoxelSteps::kSmoothed).triangles.empty());
    const auto full = test::mask_of({1, 1, 1}, [](const glm::ivec3&) { return true; });
    CHECK(surface_of_mask(full, glm::dmat4(1.0), VoxelSteps::kSmoothed).triangles.size() == 8);
}
