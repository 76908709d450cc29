// Radii that are sharpened for the kernel: the surface has those of the tree.
#include "core/field/kernel_radii.h"
#include "core/field/kernels/gaussian.h"
#include "core/field/vessel_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "tests/support/brute_force_field.h"
#include "tests/support/built_tree.h"
#include "tests/support/grown_tree.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>

using namespace ramus;

namespace {

constexpr double kWide = 2.0, kMiddle = 20.0; // mm: radius beside the stenosis, and where it is

// A straight vessel along z with a cosine-shaped stenosis of a share of its width, over so many diameters.
std::vector<tree::Point> stenosis(double share, double diameters) {
    std::vector<tree::Point> points;
    for (int n = 0; n <= 400; ++n) {
        const double z = 0.1 * n, off = std::min(std::abs(z - kMiddle) / (diameters * kWide), 1.0);
        points.push_back({{0.0, 0.0, z}, kWide * (1.0 - share * 0.5 * (1.0 + std::cos(std::numbers::pi * off)))});
    }
    return points;
}

tree::PreparedTree prepared_vessel(const std::vector<tree::Point>& points) {
    tree::PreparedTree prepared;
    prepared.centerline = tree::Centerline::kSmooth;
    test::add_branch(prepared, points);
    return prepared;
}

// The same with the kernel's radii as the tree's, for the witness.
tree::PreparedTree as_the_kernel_sees_it(tree::PreparedTree prepared) {
    for (std::size_t p = 0; p < prepared.kernel_radii.size(); ++p)
        prepared.tree.points[p].radius = prepared.kernel_radii[p];
    return prepared;
}

double radius_at(const test::BruteForceField& field, double z) {
    double near = 0.0, far = 1.5 * kWide;
    for (int n = 0; n < 30; ++n) {
        const double middle = 0.5 * (near + far);
        (field.value({middle, 0.0, z}) > field.isovalue() ? near : far) = middle;
    }
    return near;
}

double narrowest(const tree::PreparedTree& prepared, double diameters) {
    const test::BruteForceField field(prepared, 5.0);
    double least = kWide;
    for (double off = 0.0; off < diameters * kWide; off += 0.1)
        least = std::min(least, radius_at(field, kMiddle - off));
    return least;
}

// A tree whose vessels are wider and narrower in turn, three points each.
tree::VesselTree stepped(int branches) {
    tree::VesselTree tree = test::grown(branches);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i)
            if (i / 3 % 2 == 1) tree.points[branch.points[i]].radius *= 0.75;
    return tree;
}

} // namespace

TEST_CASE("stenoses of 20 to 80 % over one to five diameters keep their radius within 2 %" *
          doctest::test_suite("slow")) {
    const field::Kernel kernel = field::gaussian(5.0);
    for (const double share : {0.2, 0.5, 0.8})
        for (const double diameters : {1.0, 2.0, 3.0, 5.0}) {
            CAPTURE(share);
            CAPTURE(diameters);
            const tree::PreparedTree plain = prepared_vessel(stenosis(share, diameters));
            const tree::PreparedTree exact = as_the_kernel_sees_it(field::with_kernel_radii(plain, kernel));
            const double wanted = kWide * (1.0 - share);
            CHECK(std::abs(narrowest(exact, diameters) / wanted - 1.0) < 0.02);
            // What is to be mended: half a stenosis as long as the vessel is wide is filled by a fifth.
            if (share == 0.5 && diameters == 1.0) CHECK(narrowest(plain, diameters) > 1.2 * wanted);
        }
}

TEST_CASE("a vessel whose surface is right keeps its radii, to the bit") {
    std::vector<tree::Point> even, slow;
    for (int n = 0; n <= 60; ++n) {
        even.push_back({{0.5 * n, 0.0, 0.0}, 1.5});
        slow.push_back({{0.5 * n, 0.0, 0.0}, 1.5 + 0.005 * n});
    }
    for (const auto& points : {even, slow}) {
        const tree::PreparedTree exact = field::with_kernel_radii(prepared_vessel(points), field::gaussian(5.0));
        REQUIRE(exact.kernel_radii.size() == points.size());
        for (std::size_t p = 0; p < points.size(); ++p) CHECK(exact.kernel_radii[p] == points[p].radius);
    }
}

TEST_CASE("points that lie together change alike, and radii stay within their bounds") {
    std::vector<tree::Point> points;
    for (int n = 0; n <= 40; ++n) {
        const double z = 1.0 * n, radius = n % 8 < 4 ? 1.0 : 0.5;
        points.push_back({{0.0, 0.0, z}, radius});
        points.push_back({{0.0, 0.0, z + (n % 2 == 0 ? 1e-9 : 0.0)}, radius});
    }
    const tree::PreparedTree exact = field::with_kernel_radii(prepared_vessel(points), field::gaussian(5.0));
    double most = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double change = exact.kernel_radii[p] / points[p].radius;
        most = std::max(most, std::abs(change - 1.0));
        CHECK(change >= field::kNarrowest);
        CHECK(change <= field::kWidest);
        if (p % 2 == 1)
            CHECK(change == doctest::Approx(exact.kernel_radii[p - 1] / points[p - 1].radius).epsilon(1e-6));
    }
    CHECK(most > 0.01);
}

TEST_CASE("nodes keep their radius, and an edit changes its own branch's radii alone") {
    tree::VesselTree tree = stepped(40);
    const field::Kernel kernel = field::gaussian(5.0);
    mesh::SurfaceOptions options;
    options.centerline = tree::Centerline::kLines;
    const auto radii_of = [&] {
        return field::with_kernel_radii(mesh::prepare_tree(tree, options), kernel).kernel_radii;
    };
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, options);
    const std::vector<double> before = radii_of();
    std::size_t changed = 0;
    for (std::size_t p = 0; p < before.size(); ++p) changed += before[p] != prepared.tree.points[p].radius ? 1 : 0;
    CHECK(changed > 20);
    for (const tree::Branch& branch : prepared.tree.branches)
        for (const std::uint32_t end : {branch.points.front(), branch.points.back()})
            CHECK(before[end] == prepared.tree.points[end].radius);

    const auto longest =
        std::ranges::max_element(tree.branches, {}, [](const tree::Branch& b) { return b.points.size(); });
    tree.points[longest->points[longest->points.size() / 2]].radius *= 0.6;
    const std::vector<double> after = radii_of();
    std::vector<bool> own(before.size(), false);
    for (const std::uint32_t p : longest->points) own[p] = true;
    for (std::size_t p = 0; p < before.size(); ++p)
        if (!own[p]) CHECK(after[p] == before[p]);
}

TEST_CASE("with exact radii vertices have the tree's radius, and the surface its narrowest one") {
    const std::vector<tree::Point> points = stenosis(0.8, 1.0);
    std::vector<tree::Edge> edges;
    for (std::uint32_t p = 1; p < points.size(); ++p) edges.emplace_back(p - 1, p);
    Job job;
    for (const mesh::Blend blend : {mesh::Blend::kTree, mesh::Blend::kPaper}) {
        mesh::SurfaceOptions options;
        options.smooth_passes = 0, options.blend = blend, options.radii = mesh::Radii::kExact;
        const auto surface = mesh::make_surface(test::built_tree(points, edges), options, job);
        REQUIRE(surface);
        float least = 9.0F, narrowest = 9.0F;
        for (std::size_t v = 0; v < surface->mesh.positions.size(); ++v) {
            const glm::vec3& at = surface->mesh.positions[v];
            least = std::min(least, surface->mesh.radii[v]);
            if (std::abs(at.z - static_cast<float>(kMiddle)) < 3.0F)
                narrowest = std::min(narrowest, std::hypot(at.x, at.y));
        }
        CHECK(least == doctest::Approx(0.4).epsilon(0.01));
        CHECK(narrowest == doctest::Approx(0.4).epsilon(0.05)); // triangles of 16 around, no section
    }
}

TEST_CASE("a surface with exact radii that follows its tree is the one made from nothing, bit for bit" *
          doctest::test_suite("slow")) {
    const tree::VesselTree tree = stepped(60);
    Job job;
    mesh::SurfaceOptions options;
    options.radii = mesh::Radii::kExact;
    mesh::Polygonizer polygonizer;
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    std::mt19937 random(3);
    for (int round = 0; round < 6; ++round) {
        options.prune_ratio = round < 3 ? 0.0 : 0.2 * (round - 2);
        hidden[random() % hidden.size()] ^= 1U;
        const field::Field field = test::make_field(tree, options, hidden);
        REQUIRE(polygonizer.update(field, {}, job));
        const auto whole = mesh::polygonize(field, {}, job);
        REQUIRE(whole);
        CHECK(polygonizer.compact() == *whole);
    }
}
