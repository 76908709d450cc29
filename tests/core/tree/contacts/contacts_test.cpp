// Contacts of vessels whose courses are known.
#include "core/io/trees/tree_file.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"
#include "core/tree/contacts/contacts.h"
#include "tests/support/built_tree.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::tree {

namespace {

constexpr double kWidth = 5.0;

// Points every `step` along a line.
std::vector<Point> straight(glm::dvec3 from, glm::dvec3 to, double radius, int steps = 40) {
    std::vector<Point> points;
    for (int n = 0; n <= steps; ++n) points.push_back({from + (to - from) * (static_cast<double>(n) / steps), radius});
    return points;
}

Contacts contacts_of(const std::vector<std::vector<Point>>& vessels) {
    PreparedTree prepared;
    for (const auto& vessel : vessels) test::add_branch(prepared, vessel);
    return find_contacts(prepared, limits_of_gaussian(kWidth));
}

// Two that cross at a right angle, their axes `distance` apart.
Contacts crossing(double distance, double radius_a = 1.0, double radius_b = 1.0) {
    return contacts_of(
        {straight({-10, 0, 0}, {10, 0, 0}, radius_a), straight({0, -10, distance}, {0, 10, distance}, radius_b)});
}

} // namespace

TEST_CASE("two vessels that cross are a contact as long as their surfaces would merge") {
    for (const double closeness : {0.1, 0.5, 0.9, 1.0, 1.05, 1.09}) {
        for (const double other : {1.0, 5.0}) {
            CAPTURE(closeness);
            CAPTURE(other);
            const double sum = 1.0 + other;
            const Contacts contacts = crossing(closeness * sum, 1.0, other);
            REQUIRE(contacts.list.size() == 1);
            const Contact& contact = contacts.list[0];
            CHECK(contact.closeness == doctest::Approx(closeness).epsilon(1e-6));
            CHECK(contact.gap == doctest::Approx((closeness - 1.0) * sum).epsilon(1e-6));
            CHECK(contact.sides[0].branches == std::vector<int>{0});
            CHECK(contact.sides[1].branches == std::vector<int>{1});
            CHECK(glm::length(contact.sides[0].at) < 1e-6);
            // What is left of each is half the axis distance at least.
            for (const ContactSide& side : contact.sides) {
                CHECK(side.length > 0.0);
                CHECK(side.length <= 2.0 * 1.2 * sum); // not of whole segments
                CHECK(side.radius - side.narrowed >= std::min(side.radius, 0.5 * closeness * sum) - 1e-9);
            }
        }
    }
    CHECK(crossing(2.5).list.empty());
    CHECK_FALSE(crossing(2.5).partners.empty()); // a near miss: nothing merges, but cells may be larger than the gap
    CHECK(crossing(3.1).partners.empty());
}

// Two daughters of a fork at the origin, each `aside(x)` from the axis of the stem, along x.
template <class Aside> PreparedTree fork(const Aside& aside) {
    std::vector<Point> points = straight({-10, 0, 0}, {0, 0, 0}, 1.0, 20);
    std::vector<Edge> edges;
    for (std::uint32_t n = 1; n < points.size(); ++n) edges.emplace_back(n - 1, n);
    const auto joint = static_cast<std::uint32_t>(points.size() - 1);
    for (const double side : {-1.0, 1.0}) {
        std::uint32_t before = joint;
        for (int n = 1; n <= 60; ++n) {
            const double x = 0.5 * n;
            points.push_back({{x, side * aside(x), 0.0}, 0.8});
            const auto here = static_cast<std::uint32_t>(points.size() - 1);
            edges.emplace_back(before, here);
            before = here;
        }
    }
    PreparedTree prepared;
    prepared.tree = test::built_tree(points, edges);
    for (std::size_t b = 0; b < prepared.tree.branches.size(); ++b)
        prepared.segment_source.insert(prepared.segment_source.end(), prepared.tree.branches[b].points.size() - 1,
                                       static_cast<int>(b));
    return prepared;
}

// The middles along x of all segments that are part of a near miss.
std::vector<double> near_misses(const PreparedTree& prepared, const Contacts& contacts) {
    std::vector<double> places;
    std::size_t segment = 0;
    for (const Branch& branch : prepared.tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n) {
            const auto partners = contacts.partners_of(contacts.piece_of_segment[segment++]);
            if (std::ranges::none_of(partners, [](const auto& partner) { return partner.apart_from == 0.0F; }))
                continue;
            const auto x = [&](std::size_t at) { return prepared.tree.points[branch.points[at]].position.x; };
            places.push_back(0.5 * (x(n - 1) + x(n)));
        }
    return places;
}

TEST_CASE("daughters of a fork that stay together for a while are no contact, but are one where they meet again") {
    // Two daughters that part slowly, and then for good; or come back to each other.
    const auto contacts_of_fork = [](bool back) {
        return find_contacts(fork([&](double x) {
                                 const double apart =
                                     back ? 3.0 * std::sin(x / 30.0 * 1.8 * std::numbers::pi) : 0.25 * x;
                                 const double off = x < 1.0 ? 0.25 * x : std::max(0.25, std::abs(apart));
                                 return back && x > 12.0 ? std::max(0.8, std::abs(apart)) : off;
                             }),
                             limits_of_gaussian(kWidth));
    };
    CHECK(contacts_of_fork(false).list.empty());
    const Contacts again = contacts_of_fork(true);
    REQUIRE(again.list.size() == 1);
    CHECK(again.list[0].sides[0].at.x > 10.0);
}

TEST_CASE("daughters of a fork with a thin open gap between them are a near miss, from where they part") {
    const ContactLimits limits = limits_of_gaussian(kWidth);
    // They part, come close again without touching, and part for good; never farther than one reaches on the way.
    const auto back = [](double least) {
        return fork([=](double x) {
            const double most = 1.3, ebb = 0.5 * (1.0 - std::cos((x - 6.0) / 12.0 * 2.0 * std::numbers::pi));
            const double closeness = x < 6.0    ? most * x / 6.0
                                     : x < 18.0 ? most - (most - least) * ebb
                                                : most + 0.5 * (x - 18.0);
            return 0.8 * closeness;
        });
    };
    for (const double least : {1.13, 1.2, 1.28}) {
        CAPTURE(least);
        const PreparedTree prepared = back(least);
        const Contacts contacts = find_contacts(prepared, limits_of_gaussian(kWidth));
        CHECK(contacts.list.empty());
        const std::vector<double> places = near_misses(prepared, contacts);
        CHECK(std::ranges::count_if(places, [](double x) { return x > 11.0 && x < 13.0; }) == 2 * 4);
        // From where they part to where they are out of reach, give or take a link.
        REQUIRE_FALSE(places.empty());
        CHECK(std::ranges::min(places) > 6.0 * limits.merged / 1.3 - 0.5);
        CHECK(std::ranges::min(places) < 6.0 * limits.merged / 1.3 + 1.0);
        CHECK(std::ranges::max(places) < 18.0 + (limits.reach - 1.3) / 0.5 + 0.5);
    }
    // The steeper they part the sooner they are out of reach, and there is no thin gap at wide angles.
    const auto straight_daughters = [](double slope) {
        const PreparedTree prepared = fork([=](double x) { return slope * x; });
        const Contacts contacts = find_contacts(prepared, limits_of_gaussian(kWidth));
        CHECK(contacts.list.empty());
        return near_misses(prepared, contacts).size();
    };
    CHECK(straight_daughters(0.1) > 2 * straight_daughters(0.25));
    CHECK(straight_daughters(0.25) > 0);
    CHECK(straight_daughters(0.5) == 0);
}

TEST_CASE("a vessel that turns back on itself is a contact, and a bend is none") {
    const auto arc = [](double bend_radius, double radius, double legs) {
        std::vector<Point> points = straight({-legs, -bend_radius, 0}, {0, -bend_radius, 0}, radius, 60);
        for (int n = 1; n < 40; ++n) {
            const double angle = std::numbers::pi * (n / 40.0 - 0.5);
            points.push_back({{bend_radius * std::cos(angle), bend_radius * std::sin(angle), 0.0}, radius});
        }
        for (const Point& point : straight({0, bend_radius, 0}, {-legs, bend_radius, 0}, radius, 60))
            points.push_back(point);
        return contacts_of({points});
    };
    CHECK(arc(3.0, 1.0, 20.0).list.empty());  // far apart
    CHECK(arc(1.05, 1.0, 20.0).list.empty()); // together from the bend on
    // Legs that come together again beyond a wide bend.
    std::vector<Point> points = straight({-30, -1.02, 0}, {-10, -1.02, 0}, 1.0, 40);
    for (int n = 1; n < 80; ++n) {
        const double angle = std::numbers::pi * (2.0 * n / 80.0 - 1.0);
        points.push_back(
            {{-10.0 + 4.0 * (1.0 + std::cos(angle)), 1.02 * angle / std::numbers::pi + 4.0 * std::sin(angle), 0.0},
             1.0});
    }
    for (const Point& point : straight({-10, 1.02, 0}, {-30, 1.02, 0}, 1.0, 40)) points.push_back(point);
    const Contacts loop = contacts_of({points});
    REQUIRE(loop.list.size() == 1);
    CHECK(loop.list[0].sides[0].branches == loop.list[0].sides[1].branches);
}

TEST_CASE("turns of a coil are kept apart from their neighbours") {
    std::vector<Point> points;
    for (int n = 0; n <= 600; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / 100.0;
        points.push_back({{5.0 * std::cos(angle), 5.0 * std::sin(angle), 1.9 * n / 100.0}, 1.0});
    }
    const Contacts coil = contacts_of({points});
    REQUIRE(coil.list.size() == 1);
    CHECK(coil.list[0].gap == doctest::Approx(-0.1).epsilon(0.2));
    // Each place touches the turn below and the one above.
    const std::uint32_t middle = coil.piece_of_segment[300];
    REQUIRE(coil.partners_of(middle).size() > 2);
    CHECK(coil.partners_of(middle).front().piece < middle);
    CHECK(coil.partners_of(middle).back().piece > middle);
}

TEST_CASE("how densely a file samples its vessels does not change their contacts") {
    const auto at = [](int steps) {
        return contacts_of(
            {straight({-10, 0, 0}, {10, 0, 0}, 1.0, steps), straight({0, -10, 1.5}, {0, 10, 1.5}, 1.0, steps)});
    };
    const Contacts coarse = at(1);
    const Contacts fine = at(2000);
    REQUIRE(coarse.list.size() == 1);
    REQUIRE(fine.list.size() == 1);
    CHECK(coarse.list[0].gap == doctest::Approx(fine.list[0].gap).epsilon(1e-3));
    CHECK(fine.first_partner.size() < 300);
}

TEST_CASE("a vessel that folds back along the branches of its own fork is kept apart from all of them") {
    const auto file = test::shared_file("reports", "fold_at_fork.swc");
    if (!file) return;
    const auto tree = io::read_tree(*file);
    REQUIRE(tree);
    // The points of the fork, and of the vessel where it runs beside it; the numbers are those of the file, less 1.
    constexpr std::array<std::size_t, 4> kFork{0, 1, 2, 20};
    constexpr std::size_t kFirst = 13, kLast = 19;
    for (const int detail : {8, 16, 32}) {
        mesh::SurfaceOptions options;
        options.detail = detail;
        Job job;
        const auto surface = mesh::make_untangled_surface(*tree, options, job);
        REQUIRE(surface);
        CHECK(mesh::connectivity_of(surface->mesh) == mesh::Connectivity{1, 0});
        CHECK(surface->statistics.untangled.left == 0);
        const measure::MeshDistance solid(surface->mesh);
        for (std::size_t n = kFirst; n <= kLast; ++n) {
            const Point& a = tree->points[n];
            const auto closeness = [&](std::size_t fork) {
                const Point& b = tree->points[fork];
                return glm::distance(a.position, b.position) / (a.radius + b.radius);
            };
            const Point& b = tree->points[*std::ranges::min_element(kFork, {}, closeness)];
            // Between the tubes, as far from both in radii: the surfaces leave the gap open.
            const glm::dvec3 between = glm::mix(a.position, b.position, a.radius / (a.radius + b.radius));
            REQUIRE(glm::distance(a.position, between) > a.radius);
            CHECK_FALSE(solid.inside(between));
        }
    }
}

} // namespace ramus::tree
