// The promises of the polygonizer on real trees, against the brute-force field: raw radii, spanning 1:100 in one tree.
#include "core/field/vessel_field.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "core/tree/contacts/contacts.h"
#include "tests/support/brute_force_field.h"
#include "tests/support/mesh_intersections.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/shared_data.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <oneapi/tbb/parallel_for.h>
#include <random>

using namespace ramus;

namespace {

mesh::TriangleMesh surface_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options) {
    Job job;
    auto surface = mesh::make_surface(tree, options, job);
    REQUIRE(surface.has_value());
    return std::move(surface->mesh);
}

// Values of `count` seeded samples, computed in parallel, sorted.
template <class F> std::vector<double> sampled(std::size_t count, std::size_t range, F&& f) {
    std::mt19937 random(20051025);
    std::vector<std::size_t> picks(count);
    for (auto& pick : picks) pick = random() % range;
    std::vector<double> values(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { values[i] = f(picks[i]); });
    std::sort(values.begin(), values.end());
    return values;
}

// The value that a fraction of the sorted samples does not exceed.
double quantile(const std::vector<double>& sorted, double fraction) {
    return sorted[std::min(sorted.size() - 1,
                           static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size()))) - 1)];
}

glm::dvec3 centroid(const mesh::TriangleMesh& mesh, std::size_t n) {
    const auto& t = mesh.triangles[n];
    return (glm::dvec3(mesh.positions[t.x]) + glm::dvec3(mesh.positions[t.y]) + glm::dvec3(mesh.positions[t.z])) / 3.0;
}

constexpr std::size_t kSamples = 4000;

} // namespace

TEST_CASE("surfaces of real trees are closed manifolds on the isosurface" * doctest::test_suite("slow")) {
    for (const auto& path : test::shared_trees()) {
        CAPTURE(path.filename().string());
        const auto tree = io::read_tree(path);
        REQUIRE(tree.has_value());
        mesh::SurfaceOptions options;
        options.smooth_passes = 0;
        options.blend = mesh::Blend::kPaper;
        const tree::PreparedTree prepared = mesh::prepare_tree(*tree, options);
        const test::BruteForceField witness(prepared, options.width);
        const auto sample = [&](const glm::dvec3& at) { return witness.around(at).sample(at); };

        const mesh::TriangleMesh mesh = surface_of(*tree, options);
        const test::Topology topology = test::topology(mesh);
        CHECK(topology.open_edges == 0);
        CHECK(topology.repeated_edges == 0);
        CHECK(topology.degenerate == 0);
        CHECK(topology.split_vertices == 0);
        CHECK(topology.unused_vertices == 0);
        CHECK(topology.zero_area == 0);
        CHECK(topology.volume > 0.0);

        const auto vertices = sampled(kSamples, mesh.positions.size(), [&](std::size_t v) {
            return witness.relative_distance(sample(glm::dvec3(mesh.positions[v])));
        });
        CHECK(quantile(vertices, 0.999) < 0.005);

        const auto centroids = sampled(kSamples, mesh.triangles.size(), [&](std::size_t n) {
            return witness.relative_distance(sample(centroid(mesh, n)));
        });
        CHECK(quantile(centroids, 0.99) < 0.05);

        // Outward is down the gradient; -1 agrees, +1 is opposite.
        const auto facing = sampled(kSamples, mesh.triangles.size(), [&](std::size_t n) {
            const auto& t = mesh.triangles[n];
            const glm::dvec3 a(mesh.positions[t.x]);
            const glm::dvec3 area =
                glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
            return glm::dot(glm::normalize(area), glm::normalize(sample(centroid(mesh, n)).gradient));
        });
        CHECK(quantile(facing, 0.999) < 0.0);

        options.detail = 24;
        const mesh::TriangleMesh fine = surface_of(*tree, options);
        const auto fine_centroids = sampled(kSamples, fine.triangles.size(), [&](std::size_t n) {
            return witness.relative_distance(sample(centroid(fine, n)));
        });
        CHECK(quantile(fine_centroids, 0.99) < 0.025);
        MESSAGE(path.filename().string() << ": " << mesh.triangles.size() << " triangles, vertices 99.9 % within "
                                         << 100.0 * quantile(vertices, 0.999) << " % of r, centroids 99 % within "
                                         << 100.0 * quantile(centroids, 0.99) << " % (detail 16), "
                                         << 100.0 * quantile(fine_centroids, 0.99) << " % (detail 24)");
    }
}

// The sides of a wall may meet before they are parted: untangle_test.cpp.
TEST_CASE("next to no triangles intersect away from walls, where branches touch and where cells change their size" *
          doctest::test_suite("slow")) {
    constexpr std::size_t kTrianglesForOne = 50000;
    struct Row {
        const char* name;
        std::size_t contacts; // at least
        std::vector<int> smooth_passes;
    };
    const mesh::SurfaceOptions defaults;
    for (const auto& path : test::shared_trees())
        for (const Row& row :
             {Row{"airways_from_mask.swc", 40, {defaults.smooth_passes}}, Row{"brain_unjoined_7001.swc", 20, {0, 1}}}) {
            if (path.filename() != row.name) continue;
            CAPTURE(row.name);
            const auto tree = io::read_tree(path);
            REQUIRE(tree.has_value());
            for (const int passes : row.smooth_passes) {
                CAPTURE(passes);
                mesh::SurfaceOptions options;
                options.smooth_passes = passes;
                REQUIRE(tree::find_contacts(mesh::prepare_tree(*tree, options), tree::limits_of_gaussian(options.width))
                            .list.size() >= row.contacts);
                std::vector<mesh::TriangleBox> walls;
                Job job;
                const auto raw = mesh::polygonize(test::make_field(*tree, options, {}), {}, job, nullptr, &walls);
                REQUIRE(raw.has_value());
                const auto at_wall = [&](const test::IntersectingPair& pair) {
                    const mesh::TriangleBox box = mesh::box_of(raw->positions, raw->triangles[pair.first]);
                    return std::ranges::any_of(walls, [&](const auto& wall) { return box.meets(wall); });
                };
                const auto pairs = test::intersecting_triangles(*raw);
                const auto elsewhere = pairs.size() - static_cast<std::size_t>(std::ranges::count_if(pairs, at_wall));
                CHECK(kTrianglesForOne * elsewhere < raw->triangles.size());
            }
        }
}

TEST_CASE("real trees with radii far too large have surfaces with their pieces and loops, and nothing intersects" *
          doctest::test_suite("slow")) {
    // A loop of the first is within a branch that bends until it touches itself.
    for (const char* name : {"brain_BG001.swc", "brain_BG05.swc", "brain_BG0002.swc", "airways_from_mask.swc"}) {
        const auto path = test::shared_file("trees", name);
        if (!path) continue;
        CAPTURE(name);
        auto tree = io::read_tree(*path);
        REQUIRE(tree.has_value());
        for (tree::Point& point : tree->points) point.radius *= 1.6;
        Job job;
        const auto surface = mesh::make_untangled_surface(*tree, {}, job);
        REQUIRE(surface.has_value());
        CHECK(test::topology(surface->mesh).closed_manifold());
        CHECK(mesh::connectivity_of(surface->mesh) == mesh::connectivity_of(*tree));
        CHECK(surface->statistics.untangled.left == 0);
    }
}

TEST_CASE("one thread and two give the same bits, and so does a second run" * doctest::test_suite("slow")) {
    for (const auto& path : test::shared_trees()) {
        CAPTURE(path.filename().string());
        const auto tree = io::read_tree(path);
        REQUIRE(tree.has_value());
        mesh::SurfaceOptions options;
        options.threads = 1;
        const mesh::TriangleMesh one = surface_of(*tree, options);
        options.threads = 2;
        const mesh::TriangleMesh two = surface_of(*tree, options);
        const mesh::TriangleMesh again = surface_of(*tree, options);
        CHECK(one == two);
        CHECK(two == again);
    }
}
