// Surfaces of several vessel systems: each is what it is without the others, however near they come.
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"
#include "core/mesh/systems.h"
#include "core/mesh/tree_field.h"
#include "core/tree/build_tree.h"
#include "tests/support/mesh_topology.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

// Two straight vessels with a radius of 2 mm, `apart` from each other, of two systems or of none.
tree::VesselTree two_vessels(double apart, bool systems) {
    tree::Graph graph;
    for (const double y : {0.0, apart})
        for (const double x : {-10.0, 0.0, 10.0}) graph.points.push_back({{x, y, 0.0}, 2.0});
    graph.edges = {{0, 1}, {1, 2}, {3, 4}, {4, 5}};
    graph.roots = {0, 3};
    if (systems) {
        graph.systems = {{"portal vein", {60, 110, 180}}, {"hepatic vein", {200, 80, 60}}};
        graph.point_systems = {0, 0, 0, 1, 1, 1};
    }
    auto tree = tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string(); });
    REQUIRE(tree);
    return std::move(*tree);
}

mesh::TriangleMesh surface_without(const tree::VesselTree& tree, const mesh::SurfaceOptions& options = {},
                                   std::vector<std::uint8_t> hidden = {}) {
    Job job;
    auto surface = mesh::make_surface(tree, options, job, hidden);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    return std::move(surface->mesh);
}

} // namespace

TEST_CASE("vessels of two systems that overlap have a closed surface each") {
    // Half of each vessel's width lies within the other: the field of both together is one.
    const mesh::SurfaceOptions merged{.blend = mesh::Blend::kPaper};
    CHECK(mesh::component_count(surface_without(two_vessels(2.0, false), merged)) == 1);
    const mesh::TriangleMesh apart = surface_without(two_vessels(2.0, true));
    CHECK(mesh::component_count(apart) == 2);
    CHECK(test::topology(apart).closed_manifold());
}

TEST_CASE("the surface of a system is what it is with the others hidden") {
    const tree::VesselTree tree = two_vessels(2.0, true);
    for (const mesh::Method method : {mesh::Method::kConvolutionSurface, mesh::Method::kTruncatedCones}) {
        mesh::SurfaceOptions options;
        options.method = method;
        mesh::TriangleMesh both = surface_without(tree, options, {0, 1});
        mesh::append(both, surface_without(tree, options, {1, 0}));
        CHECK(surface_without(tree, options) == both);
    }
}

TEST_CASE("pruning and smoothing leave every branch in its system") {
    const tree::VesselTree tree = two_vessels(2.0, true);
    mesh::SurfaceOptions options;
    options.prune_ratio = 0.3;
    options.smooth_passes = 3;
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, options);
    CHECK(prepared.tree.systems == tree.systems);
    REQUIRE(prepared.tree.branches.size() == 2);
    for (std::size_t id = 0; id < 2; ++id) CHECK(prepared.tree.branches[id].system == static_cast<int>(id));
    CHECK(mesh::component_count(surface_without(tree, options)) == 2);
}

TEST_CASE("a tree of one visible system is made in one") {
    const tree::VesselTree tree = two_vessels(2.0, true), plain = two_vessels(2.0, false);
    CHECK(mesh::hidden_by_system(plain, {}).size() == 1);
    CHECK(mesh::hidden_by_system(plain, {}).front().empty());
    const std::vector<std::uint8_t> first_hidden{1, 0};
    const std::vector<std::vector<std::uint8_t>> alone{first_hidden};
    CHECK(mesh::hidden_by_system(tree, first_hidden) == alone);
    CHECK(surface_without(tree, {}, first_hidden) == surface_without(plain, {}, first_hidden));
}
