// Surfaces of every kernel: where they are, and what they are.
#include "core/field/convolution_field.h"
#include "core/field/kernels/kernel_kind.h"
#include "core/mesh/check_kernel.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/grown_tree.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/surface_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

using field::KernelKind;

constexpr std::array<std::pair<KernelKind, double>, 9> kKernelsToTry = {{{KernelKind::kGaussian, 5.0},
                                                                         {KernelKind::kInverseCubic, 5.0},
                                                                         {KernelKind::kInverseSquare, 5.0},
                                                                         {KernelKind::kCauchy, 1.0},
                                                                         {KernelKind::kCauchy, 5.0},
                                                                         {KernelKind::kPolynomial, 1.0},
                                                                         {KernelKind::kPolynomial, 3.0},
                                                                         {KernelKind::kPolynomial, 5.0},
                                                                         {KernelKind::kPolynomial, 10.0}}};

SurfaceOptions kernel_options(std::pair<KernelKind, double> kernel, Blend blend) {
    SurfaceOptions options;
    options.kernel = kernel.first;
    options.width = kernel.second;
    options.blend = blend;
    return options;
}

TriangleMesh kernel_surface_of(const tree::VesselTree& tree, const SurfaceOptions& options) {
    Job job;
    auto surface = make_surface(tree, options, job);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    return std::move(surface->mesh);
}

TriangleMesh kernel_surface_of(const tree::PreparedTree& prepared, const field::Kernel& kernel) {
    Job job;
    auto mesh = polygonize(field::ConvolutionField(field::Skeleton(prepared, kernel.support_radii), kernel), {}, job);
    REQUIRE(mesh);
    return std::move(*mesh);
}

} // namespace

TEST_CASE("with every kernel a long vessel has its radius, in one piece or cut into many") {
    for (const auto& kind : kKernelsToTry)
        for (const int pieces : {1, 60}) {
            CAPTURE(field::row_of(kind.first).key);
            CAPTURE(kind.second);
            CAPTURE(pieces);
            const field::Kernel kernel = field::make_kernel(kind.first, kind.second);
            const glm::dvec3 along = glm::normalize(glm::dvec3(3.0, 2.0, 1.0));
            const double length = 60.0;
            std::vector<tree::Point> points;
            for (int n = 0; n <= pieces; ++n) points.push_back({length * n / pieces * along, 2.0});
            tree::PreparedTree prepared;
            test::add_branch(prepared, points);
            const TriangleMesh mesh = kernel_surface_of(prepared, kernel);
            const test::Topology topology = test::topology(mesh);
            CHECK(topology.closed_manifold());
            CHECK(topology.euler == 2);
            // As far from the ends as they change nothing, there are a few vertices around.
            double worst = 0.0;
            std::size_t counted = 0;
            for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                const glm::dvec3 p(mesh.positions[v]);
                const double t = glm::dot(p, along);
                if (std::min(t, length - t) < 2.0 * kernel.support_radii) continue;
                const double radius = glm::length(p - t * along);
                // Two steps of Newton's method leave as much with the Gaussian (kernels/gaussian-inl.h).
                worst = std::max(worst, std::abs(radius / 2.0 - 1.0));
                ++counted;
            }
            CHECK(counted > 100);
            CHECK(worst < 0.003);
        }
}

TEST_CASE("with every kernel two parallel vessels merge where its limit says") {
    for (const auto& kind : kKernelsToTry) {
        const field::Kernel kernel = field::make_kernel(kind.first, kind.second);
        // The middle between the two is the last place to come inside; cells are finer than the gap.
        for (const double closeness : {0.99 * kernel.limits.merged, 1.01 * kernel.limits.merged}) {
            CAPTURE(field::row_of(kind.first).key);
            CAPTURE(kind.second);
            CAPTURE(closeness);
            const double apart = 2.0 * closeness; // of radius 1
            tree::PreparedTree prepared;
            test::add_branch(prepared, {{{-20.0, 0.0, 0.0}, 1.0}, {{20.0, 0.0, 0.0}, 1.0}});
            test::add_branch(prepared, {{{-20.0, apart, 0.0}, 1.0}, {{20.0, apart, 0.0}, 1.0}});
            const field::ConvolutionField field(field::Skeleton(prepared, kernel.support_radii), kernel);
            const auto brick = field.in_brick();
            const std::array<std::uint32_t, 2> both{0, 1};
            field::LatticeAxes lattice;
            field::GridAxes grid;
            lattice.y.fill(0.5 * apart), lattice.x.fill(0.1), lattice.z.fill(0.0);
            grid.x = {0.1, 0.2, 0.3, 0.4, 0.5};
            grid.y = {0.5 * apart, 0.5 * apart + 0.1, 0.5 * apart + 0.2, 0.5 * apart + 0.3, 0.5 * apart + 0.4};
            grid.z = {0.0, 0.1, 0.2, 0.3, 0.4};
            brick->enter(both, grid);
            const std::array<field::LatticePoint, 1> middle{{{0, 0, 0}}};
            std::array<float, 1> value{};
            brick->sample_lattice(lattice, middle, value);
            CHECK((value[0] >= field.isovalue()) == (closeness < kernel.limits.merged));
        }
    }
}

TEST_CASE("with every kernel a grown tree has one closed surface, of the plain sum and along the tree" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = test::grown(31);
    for (const auto& kind : kKernelsToTry)
        for (const Blend blend : {Blend::kPaper, Blend::kTree}) {
            CAPTURE(field::row_of(kind.first).key);
            CAPTURE(kind.second);
            CAPTURE(name_of(blend));
            const SurfaceOptions options = kernel_options(kind, blend);
            if (!check_kernel(options)) continue;
            const TriangleMesh mesh = kernel_surface_of(tree, options);
            const test::Topology topology = test::topology(mesh);
            CHECK(topology.closed_manifold());
            CHECK(topology.volume > 0.0);
            CHECK(topology.euler == 2);
        }
}

TEST_CASE("along the tree, packed vessels have the pieces and loops of their axes with every kernel that is taken" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = test::packed_trees(1);
    int taken = 0;
    for (const auto& kind : kKernelsToTry) {
        CAPTURE(field::row_of(kind.first).key);
        CAPTURE(kind.second);
        const SurfaceOptions options = kernel_options(kind, Blend::kTree);
        if (kind.first == KernelKind::kGaussian || !check_kernel(options)) continue;
        ++taken;
        const TriangleMesh mesh = kernel_surface_of(tree, options);
        CHECK(test::topology(mesh).closed_manifold());
        CHECK(test::wrong_pieces(mesh, test::pieces_of(mesh), test::pieces_of(prepare_tree(tree, options))).none());
    }
    CHECK(taken == 6);
}

TEST_CASE(
    "a kernel that reaches too far to keep vessels apart is refused with a word, and so is a width it does not take") {
    const tree::VesselTree tree = test::built_tree({{{0.0, 0.0, 0.0}, 1.0}, {{9.0, 0.0, 0.0}, 1.0}}, {{0, 1}});
    Job job;
    const auto refused = make_surface(tree, kernel_options({KernelKind::kInverseSquare, 5.0}, Blend::kTree), job);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("--blend paper") != std::string::npos);
    CHECK_FALSE(make_surface(tree, kernel_options({KernelKind::kCauchy, 1.0}, Blend::kTree), job));
    CHECK(make_surface(tree, kernel_options({KernelKind::kCauchy, 1.0}, Blend::kPaper), job));
    const auto wide = make_surface(tree, kernel_options({KernelKind::kPolynomial, 20.0}, Blend::kPaper), job);
    REQUIRE_FALSE(wide);
    CHECK(wide.error().message().find("from 0.1 to 10") != std::string::npos);
    // Truncated cones have no kernel.
    SurfaceOptions cones = kernel_options({KernelKind::kInverseSquare, 5.0}, Blend::kTree);
    cones.method = Method::kTruncatedCones;
    CHECK(make_surface(tree, cones, job));
}

} // namespace ramus::mesh
