// Trees of masks whose vessels are known.
#include "core/mesh/connectivity.h"
#include "core/volume/isosurface.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "core/volume/skeletonize/topology.h"
#include "tests/support/mask.h"
#include "tests/support/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <random>
#include <set>

using namespace ramus;
using volume::BitMask;

namespace {

tree::VesselTree tree_of(const BitMask& mask, const glm::dvec3& spacing = glm::dvec3(1.0),
                         const volume::SkeletonizeOptions& options = {},
                         volume::SkeletonizeFigures* figures = nullptr) {
    Job job;
    auto tree = volume::skeletonize(mask, test::voxels_of(spacing), options, job, figures);
    REQUIRE_MESSAGE(tree, (tree ? "" : tree.error().message()));
    return std::move(*tree);
}

// A round tube along `axis`, across which the others are x and y.
BitMask tube(int length, double radius, const glm::dvec3& spacing, int axis, const glm::dvec3& centre) {
    glm::ivec3 size(1);
    for (int a = 0; a < 3; ++a) size[a] = a == axis ? length + 6 : static_cast<int>(2.0 * centre[a] / spacing[a]) + 2;
    return test::mask_of(size, [&](const glm::ivec3& voxel) {
        if (voxel[axis] < 3 || voxel[axis] >= length + 3) return false;
        glm::dvec3 away = spacing * glm::dvec3(voxel) - centre;
        away[axis] = 0.0;
        return glm::length(away) <= radius;
    });
}

// A ring of vessels in the plane of x and y, around the middle of a box of 40 voxels a side.
bool in_ring(const glm::dvec3& at, double radius) {
    const double out = std::hypot(at.x - 20.0, at.y - 20.0) - 12.0;
    return std::hypot(out, at.z - 20.0) <= radius;
}

} // namespace

TEST_CASE("the centerline of a tube is its axis, its radius that of its cross-section, on voxels of any proportions") {
    for (const glm::dvec3& spacing : {glm::dvec3(1.0), glm::dvec3(0.5, 0.5, 2.0), glm::dvec3(0.7, 1.1, 0.4)})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(spacing.z);
            CAPTURE(axis);
            const glm::dvec3 centre(8.2, 7.9, 8.4);
            const double radius = 4.0;
            const int length = static_cast<int>(60.0 / spacing[axis]);
            const BitMask mask = tube(length, radius, spacing, axis, centre);
            const tree::VesselTree tree = tree_of(mask, spacing);
            REQUIRE(tree.branches.size() == 1);
            const double area = static_cast<double>(mask.count()) * spacing.x * spacing.y * spacing.z /
                                (length * spacing[axis] * std::numbers::pi);
            glm::dvec3 across = spacing;
            across[axis] = 0.0;
            double sum = 0.0;
            for (const tree::Point& point : tree.points) {
                glm::dvec3 away = point.position - centre;
                away[axis] = 0.0;
                CHECK(glm::length(away) < 0.35 * glm::length(across));
                CHECK(point.radius == doctest::Approx(std::sqrt(area)).epsilon(0.1));
                sum += std::abs(point.radius - std::sqrt(area));
            }
            const double largest = std::max({across.x, across.y, across.z});
            CHECK(sum / static_cast<double>(tree.points.size()) < 0.1 * largest);
            // The surface of a tree goes sqrt(1/2) r beyond its last points.
            const double begin = (3.0 - 0.5) * spacing[axis], end = (length + 3.0 - 0.5) * spacing[axis];
            double least = HUGE_VAL, most = -HUGE_VAL;
            for (const tree::Point& point : tree.points) {
                least = std::min(least, point.position[axis] - std::sqrt(0.5) * point.radius);
                most = std::max(most, point.position[axis] + std::sqrt(0.5) * point.radius);
            }
            CHECK(std::abs(least - begin) < std::max(0.25 * radius, spacing[axis]));
            CHECK(std::abs(most - end) < std::max(0.25 * radius, spacing[axis]));
        }
}

TEST_CASE("vessels of one and two voxels have the area of their voxels, and reach as far") {
    for (const int width : {1, 2, 3}) {
        CAPTURE(width);
        const BitMask mask = test::mask_of({40, 8, 8}, [&](const glm::ivec3& v) {
            return v.x >= 4 && v.x < 36 && v.y >= 2 && v.y < 2 + width && v.z >= 2 && v.z < 2 + width;
        });
        const tree::VesselTree tree = tree_of(mask);
        REQUIRE(tree.branches.size() == 1);
        const double middle = 2.0 + 0.5 * (width - 1), radius = width / std::sqrt(std::numbers::pi);
        for (const tree::Point& point : tree.points) {
            CHECK(std::abs(point.position.y - middle) < 0.1);
            CHECK(std::abs(point.position.z - middle) < 0.1);
            CHECK(point.radius == doctest::Approx(radius).epsilon(0.02));
        }
        double length = 2.0 * std::sqrt(0.5) * radius;
        length += length_mm(tree, tree.branches[0]);
        CHECK(length == doctest::Approx(32.0).epsilon(0.02));
    }
}

TEST_CASE("a Y is three branches with the radii of its arms, and the thickest end is its root") {
    const auto arm = [](const glm::dvec3& at, const glm::dvec3& a, const glm::dvec3& b, double radius) {
        const double t = std::clamp(glm::dot(at - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        return glm::distance(at, a + t * (b - a)) <= radius;
    };
    const glm::dvec3 root(30, 30, 6), fork(30, 30, 40), left(10, 30, 74), right(50, 30, 74);
    const BitMask mask = test::mask_of({62, 60, 86}, [&](const glm::ivec3& voxel) {
        const glm::dvec3 at(voxel);
        return arm(at, root, fork, 5.0) || arm(at, fork, left, 3.5) || arm(at, fork, right, 3.0);
    });
    const tree::VesselTree tree = tree_of(mask);
    REQUIRE(tree.branches.size() == 3);
    REQUIRE(tree.roots.size() == 1);
    CHECK(glm::distance(tree.points[tree.roots[0]].position, root) < 5.0);
    const auto middle = [&](std::size_t b) {
        const auto& points = tree.branches[b].points;
        return tree.points[points[points.size() / 2]];
    };
    for (std::size_t b = 0; b < 3; ++b) {
        const tree::Point at = middle(b);
        const double radius = at.position.z < 40.0 ? 5.0 : at.position.x < 30.0 ? 3.5 : 3.0;
        CHECK(std::abs(at.radius - radius) < 0.2);
    }
    // Or the root is where somebody says.
    volume::SkeletonizeOptions options;
    options.root = glm::dvec3(9, 31, 80);
    const tree::VesselTree other = tree_of(mask, glm::dvec3(1.0), options);
    CHECK(glm::distance(other.points[other.roots[0]].position, left) < 5.0);
}

TEST_CASE("bumps on a wall are no vessels, unless they are asked for") {
    const BitMask mask = test::mask_of({80, 30, 30}, [](const glm::ivec3& v) {
        const bool in_tube = v.x > 4 && v.x < 75 && std::hypot(v.y - 15.0, v.z - 15.0) <= 6.0;
        const glm::dvec3 bump(40.0, 21.0, 15.0); // half a ball of 3 voxels
        return in_tube || glm::distance(glm::dvec3(v), bump) <= 3.0;
    });
    CHECK(tree_of(mask).branches.size() == 1);
    volume::SkeletonizeOptions options;
    options.bulge_size = 3.0; // a side vessel as long as it is wide goes too
    const BitMask stump = test::mask_of({80, 40, 30}, [](const glm::ivec3& v) {
        const bool in_tube = v.x > 4 && v.x < 75 && std::hypot(v.y - 15.0, v.z - 15.0) <= 6.0;
        return in_tube || (v.y > 15 && v.y < 30 && std::hypot(v.x - 40.0, v.z - 15.0) <= 3.0);
    });
    CHECK(tree_of(stump).branches.size() == 3);
    CHECK(tree_of(stump, glm::dvec3(1.0), options).branches.size() == 1);
}

TEST_CASE("loops stay loops, or are closed when asked; cavities are filled; both are said") {
    const auto ring = [](const glm::ivec3& voxel) { return in_ring(glm::dvec3(voxel), 4.0); };
    const auto with_cavity = [&](const glm::ivec3& v) {
        return ring(v) && !(std::abs(v.x - 32) < 2 && std::abs(v.y - 20) < 2 && std::abs(v.z - 20) < 2);
    };
    volume::SkeletonizeFigures figures;
    const tree::VesselTree loop = tree_of(test::mask_of({41, 41, 41}, with_cavity), glm::dvec3(1.0), {}, &figures);
    CHECK(loop.loop_count == 1);
    CHECK(figures.tunnels == 1);
    CHECK(figures.cavities_filled == 1);
    CHECK(loop.notes.at(0).text == "1 cavity was filled");
    double length = 0.0;
    for (const tree::Branch& branch : loop.branches) length += length_mm(loop, branch);
    CHECK(length == doctest::Approx(2.0 * std::numbers::pi * 12.0).epsilon(0.02));

    // With a stem, so that there is an end.
    const BitMask mask = test::mask_of({41, 41, 41}, [&](const glm::ivec3& v) {
        return ring(v) || (v.x > 20 && std::hypot(v.y - 20.0, v.z - 20.0) < 3.0 && v.x < 38);
    });
    volume::SkeletonizeOptions closing;
    closing.fill_holes = true;
    const tree::VesselTree open = tree_of(mask, glm::dvec3(1.0), closing);
    CHECK(open.loop_count == 0);
    CHECK(std::ranges::count(open.notes, "fill-holes", &tree::Note::topic) == 1);
    CHECK(open.notes.at(0).at.has_value());
}

TEST_CASE("small pieces are left out when asked") {
    const BitMask mask = test::mask_of({60, 12, 12}, [](const glm::ivec3& v) {
        const bool large = v.x < 40 && std::hypot(v.y - 5.0, v.z - 5.0) <= 3.0;
        return large || (v.x > 50 && v.x < 55 && v.y > 3 && v.y < 7 && v.z == 5);
    });
    CHECK(tree_of(mask).roots.size() == 2);
    volume::SkeletonizeOptions options;
    options.islands_mm = 6.0;
    volume::SkeletonizeFigures figures;
    const tree::VesselTree tree = tree_of(mask, glm::dvec3(1.0), options, &figures);
    CHECK(tree.roots.size() == 1);
    CHECK(figures.islands_dropped == 1);
    options.islands_mm = 100.0;
    Job job;
    const auto nothing = volume::skeletonize(mask, glm::dmat4(1.0), options, job);
    REQUIRE_FALSE(nothing);
    CHECK(nothing.error().hint == "lower --islands");
}

TEST_CASE("whatever the mask is, the tree has its pieces and its tunnels") {
    // The mask's isosurface is the witness: its components, and its genus.
    for (unsigned seed = 0; seed < 120; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::bernoulli_distribution set(0.1 + 0.5 * static_cast<double>(seed % 10) / 10.0);
        BitMask mask = test::mask_of({9, 8, 10}, [&](const glm::ivec3&) { return set(random); });
        if (mask.count() == 0) continue;
        volume::SparseMask filled(mask);
        volume::fill_cavities(filled);
        mask = test::bits_of(filled);
        Job job;
        const auto surface = volume::mask_surface(mask, glm::dmat4(1.0), {}, job);
        REQUIRE(surface);
        const int pieces = mesh::component_count(*surface);
        const int loops = pieces - test::topology(*surface).euler / 2;
        const tree::VesselTree tree = tree_of(mask, glm::dvec3(1.0, 1.0, 1.0 + 0.3 * (seed % 4)));
        CHECK(static_cast<int>(tree.roots.size()) == pieces);
        CHECK(tree.loop_count == loops);
    }
}

TEST_CASE("a mask that is cancelled, empty, or too large for the memory is refused") {
    const BitMask mask = test::mask_of({60, 30, 30}, [](const glm::ivec3& v) { return v.y > 3 && v.z > 3; });
    Job job;
    volume::SkeletonizeOptions options;
    options.memory_bytes = 1e6;
    const auto large = volume::skeletonize(mask, glm::dmat4(1.0), options, job);
    REQUIRE_FALSE(large);
    CHECK(large.error().hint.find("--memory") != std::string::npos);
    CHECK_FALSE(volume::skeletonize(BitMask({4, 4, 4}), glm::dmat4(1.0), {}, job));
    job.cancel();
    const auto cancelled = volume::skeletonize(mask, glm::dmat4(1.0), {}, job);
    REQUIRE_FALSE(cancelled);
    CHECK(cancelled.error().what == "cancelled");
}

TEST_CASE("few voxels in a large volume have the tree that they have in a small one") {
    // The volume has more words than are kept for voxels so few; words begin at the same voxels in both.
    constexpr glm::ivec3 kSize(40, 30, 35), kLarge(800), kOffset(320, 411, 377);
    std::mt19937 random(3);
    std::bernoulli_distribution set(0.3);
    // Nothing at the border of the small one, where vessels count as cut.
    const BitMask small = test::mask_of(kSize, [&](const glm::ivec3& v) {
        const bool within = glm::all(glm::greaterThan(v, glm::ivec3(1))) && glm::all(glm::lessThan(v, kSize - 2));
        return set(random) && within;
    });
    BitMask large(kLarge);
    for (int k = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 0; i < kSize.x; ++i)
                if (small.test({i, j, k})) large.set(kOffset + glm::ivec3(i, j, k));
    large.set({0, 0, 0}), large.set({799, 799, 799}); // pieces of their own, the first one and the last one
    const volume::SparseMask sparse(large);
    CHECK(sparse.places() < 20'000);
    CHECK(sparse.count() == small.count() + 2);
    CHECK(test::bits_of(sparse).count() == large.count());
    const glm::dvec3 spacing(0.5, 0.75, 1.0);
    const tree::VesselTree alone = tree_of(small, spacing), within = tree_of(large, spacing);
    CHECK(within.loop_count == alone.loop_count);
    REQUIRE(within.roots.size() == alone.roots.size() + 2);
    // Rounding, which is another one farther from the origin, decides between places that are as good: few points
    // differ.
    const auto places_of = [&](const tree::VesselTree& tree, const glm::dvec3& corner) {
        std::set<std::array<std::int64_t, 4>> places;
        for (const tree::Point& point : tree.points) {
            const glm::dvec3 at = (point.position - spacing * corner) * 1e6;
            if (glm::all(glm::greaterThan(at, glm::dvec3(-1.0))) && glm::all(glm::lessThan(at, glm::dvec3(1e8))))
                places.insert(
                    {std::llround(at.x), std::llround(at.y), std::llround(at.z), std::llround(point.radius * 1e6)});
        }
        return places;
    };
    const auto expected = places_of(alone, glm::dvec3(0.0)), found = places_of(within, glm::dvec3(kOffset));
    CHECK(found.size() == doctest::Approx(static_cast<double>(expected.size())).epsilon(0.01));
    const auto same = std::ranges::count_if(found, [&](const auto& place) { return expected.contains(place); });
    CHECK(static_cast<double>(same) > 0.97 * static_cast<double>(expected.size()));
}
