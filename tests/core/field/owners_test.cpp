// Whose points are, where vessels are kept apart.
#include "core/field/separation.h"
#include "tests/support/built_tree.h"
#include "tests/support/tree_field.h"

#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

namespace ramus::field {

TEST_CASE("a point farther from every axis than vessels claim is nobody's, however many lift the field there") {
    // N equal branches that meet in a plane lift the surface over their joint to sqrt(1 + log2(N / 2) / width): 1.29
    // radii for 20 at width 5. A vessel passes above, so near that cells might bridge the gap.
    constexpr int kBranches = 20;
    constexpr double kAbove = 2.6;
    std::vector<tree::Point> points{{{0, 0, 0}, 1.0}};
    std::vector<tree::Edge> edges;
    for (std::uint32_t n = 1; n <= kBranches; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / kBranches;
        points.push_back({{20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0}, 1.0});
        edges.emplace_back(0, n);
    }
    points.push_back({{-20, 0.5, kAbove}, 1.0}), points.push_back({{20, 0.5, kAbove}, 1.0});
    edges.emplace_back(kBranches + 1, kBranches + 2);
    mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    const tree::VesselTree tree = test::built_tree(points, edges, {0, kBranches + 1});
    const Field field = test::make_field(tree, options, {});

    const auto brick = field.in_brick();
    GridAxes axes;
    LatticeAxes lattice;
    constexpr double kLeast = 1.0, kCell = 0.2;
    for (std::size_t n = 0; n < kGridSide; ++n) {
        axes.x[n] = axes.y[n] = kCell * static_cast<double>(n);
        axes.z[n] = kLeast + kCell * static_cast<double>(n);
    }
    for (std::size_t n = 0; n < kLatticeSide; ++n) lattice.z[n] = kLeast + 0.02 * static_cast<double>(n);
    brick->enter(field.skeleton().present(), axes);
    Separation* separation = brick->separation();
    REQUIRE(separation != nullptr);
    const auto look = [&](std::uint8_t k) {
        const LatticePoint point{0, 0, k};
        float value = 0.0F;
        Owner owner = kNoOwner;
        (void)brick->sample_lattice(lattice, {&point, 1}, {&value, 1});
        (void)separation->find_owners(lattice, {&point, 1}, {&owner, 1});
        return std::pair(value >= field.isovalue(), owner != kNoOwner);
    };
    CHECK(look(12) == std::pair(true, true));   // at 1.24
    CHECK(look(13) == std::pair(true, false));  // at 1.26
    CHECK(look(14) == std::pair(true, false));  // at 1.28
    CHECK(look(15) == std::pair(false, false)); // at 1.30
}

} // namespace ramus::field
