// Trees of masks of patients: their topology, and how far their surface is from that of the mask.
#include "core/io/volumes/volume_file.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/surface.h"
#include "core/volume/isosurface.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "core/volume/skeletonize/topology.h"
#include "tests/support/shared_data.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <string>

using namespace ramus;

namespace {

struct Known {
    const char* name;
    std::size_t pieces;
    int tunnels;
};
constexpr Known kKnown[] = {{"liver_002_vessels.nii.gz", 1, 7},
                            {"circle_of_willis_mr_003.nii.gz", 2, 1},
                            {"aorta_0066_mask.mha", 1, 0},
                            {"airways_lumen.nii.gz", 1, 58},
                            {"kidney.nii.gz", 1, 49}};

struct Distances {
    double mean = 0.0, above = 0.0; // mm; the part that is farther than a limit
};
Distances distances(const mesh::TriangleMesh& from, const measure::MeshDistance& to, double limit) {
    using Sums = std::pair<double, double>;
    const Sums sums = oneapi::tbb::parallel_deterministic_reduce(
        oneapi::tbb::blocked_range<std::size_t>(0, from.positions.size(), 4096), Sums(),
        [&](const auto& range, Sums sum) {
            for (std::size_t n = range.begin(); n != range.end(); ++n) {
                const double away = to.surface_distance(glm::dvec3(from.positions[n]));
                sum.first += away, sum.second += away > limit ? 1.0 : 0.0;
            }
            return sum;
        },
        [](const Sums& a, const Sums& b) { return Sums(a.first + b.first, a.second + b.second); });
    const auto count = static_cast<double>(from.positions.size());
    return {sums.first / count, sums.second / count};
}

double volume_of(const mesh::TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& triangle : mesh.triangles) {
        const auto at = [&](int corner) {
            return glm::dvec3(mesh.positions[triangle[static_cast<std::size_t>(corner)]]);
        };
        sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
    }
    return sum;
}

// Twice the common volume over the sum of both.
double dice(const volume::BitMask& mask, const glm::dmat4& to_patient, const mesh::TriangleMesh& mesh,
            const measure::MeshDistance& surface) {
    const std::size_t common = oneapi::tbb::parallel_deterministic_reduce(
        oneapi::tbb::blocked_range<int>(0, mask.size().z), std::size_t{0},
        [&](const auto& range, std::size_t sum) {
            for (int k = range.begin(); k != range.end(); ++k)
                for (int j = 0; j < mask.size().y; ++j)
                    for (int i = 0; i < mask.size().x; ++i)
                        if (mask.test({i, j, k}) && surface.inside(glm::dvec3(to_patient * glm::dvec4(i, j, k, 1))))
                            ++sum;
            return sum;
        },
        std::plus<>());
    const double voxels = volume_of(mesh) / volume::voxel_volume_mm3(to_patient);
    return 2.0 * static_cast<double>(common) / (static_cast<double>(mask.count()) + voxels);
}

} // namespace

TEST_CASE("trees of real masks have their topology, and surfaces close to theirs" * doctest::test_suite("slow")) {
    for (const Known& known : kKnown) {
        const auto path = test::shared_volume(known.name);
        if (!path) continue;
        const std::string name = known.name;
        CAPTURE(name);
        Job job;
        const auto read = io::read_volume(*path, {}, job);
        REQUIRE(read);
        const glm::dmat4 to_patient = read->to_patient;
        const auto mask = volume::inside(*read, {}, JobRange(job, 0.0F, 1.0F));
        REQUIRE(mask);
        const auto tree = volume::skeletonize(*mask, to_patient, {}, job);
        REQUIRE(tree);
        CHECK(tree->roots.size() == known.pieces);
        CHECK(tree->loop_count == known.tunnels);

        // Of Table I is the default; the centerlines themselves are held against the mask as they are.
        const auto table = mesh::make_surface(*tree, {}, job);
        REQUIRE(table);
        const auto surface = mesh::make_surface(*tree, {.smooth_passes = 0}, job);
        REQUIRE(surface);
        const auto wall = volume::mask_surface(*mask, to_patient, {}, job);
        REQUIRE(wall);
        const double diagonal = glm::length(volume::spacing_mm(to_patient));
        const measure::MeshDistance to_wall(*wall), to_surface(surface->mesh);
        // Table I of the paper: 8.74 % of a convolution surface at most lie farther than half a diagonal.
        const Distances out = distances(table->mesh, to_wall, 0.5 * diagonal);
        CHECK(out.mean <= 0.25 * diagonal);
        CHECK(out.above <= 0.0874);
        const Distances in = distances(*wall, to_surface, 1.5 * diagonal);
        CHECK(1.0 - in.above >= 0.97);
        MESSAGE(name << ": " << tree->branches.size() << " branches; surface to mask " << out.mean / diagonal
                     << " diagonals in the mean, " << 100.0 * out.above << " % above a half; of the mask's surface "
                     << 100.0 * (1.0 - in.above) << " % within 1.5; Dice "
                     << dice(*mask, to_patient, surface->mesh, to_surface));
    }
}
