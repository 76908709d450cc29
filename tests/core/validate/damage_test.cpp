// Damage of each kind at many places of grown trees and of a real one: each is found where it is, and nothing else.
#include "core/io/trees/tree_file.h"
#include "core/mesh/surface.h"
#include "core/tree/contacts/contacts.h"
#include "core/validate/validation.h"
#include "tests/support/damaged_tree.h"
#include "tests/support/grown_tree.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

using namespace ramus;
using tree::Point;
using tree::VesselTree;

namespace {

constexpr double kNear = 2.0; // mm: damage is found at its place
constexpr int kGrownBranches = 31;
// Triangles around a vessel. Each damage needs a surface of its own. That of a real tree has 3.4 million triangles at
// the default; damage is larger than the triangles of a coarser surface.
constexpr int kDefaultDetail = mesh::SurfaceOptions{}.detail, kCoarseDetail = 8;

mesh::TriangleMesh damaged_surface(const VesselTree& tree, int detail, mesh::Blend blend = mesh::Blend::kTree) {
    mesh::SurfaceOptions options;
    options.detail = detail;
    options.blend = blend;
    Job job;
    auto surface = mesh::make_surface(tree, options, job);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    return std::move(surface->mesh);
}

validate::Validation look_at(const VesselTree& tree, const mesh::TriangleMesh& surface) {
    Job job;
    auto found = validate::validate(tree, surface, {tree::limits_of_gaussian(5.0), 0}, job);
    REQUIRE(found);
    return std::move(*found);
}

std::size_t findings(const validate::Validation& found) {
    return found.lost.size() + found.false_parts.size() + found.merged.size() + found.constrictions.size() +
           found.widths.size() + found.positions.size();
}

// Branches that end free and hang on another one.
std::vector<int> leaves_of(const VesselTree& tree) {
    std::vector<int> leaves;
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (tree.branches[id].children.empty() && tree.branches[id].parent != tree::kNoBranch)
            leaves.push_back(static_cast<int>(id));
    return leaves;
}

void check_lost_leaves(const VesselTree& tree, int detail, std::size_t every) {
    const std::vector<int> leaves = leaves_of(tree);
    for (std::size_t i = 0; i < leaves.size(); i += every) {
        CAPTURE(leaves[i]);
        const validate::Validation found =
            look_at(tree, damaged_surface(test::without_branch(tree, leaves[i]), detail));
        REQUIRE(found.lost.size() == 1);
        CHECK(findings(found) == 1);
        CHECK(found.lost[0].branch == leaves[i]);
    }
}

// A ghost of 15 mm, which stands on a branch's middle point, if there is room around it.
struct Ghost {
    std::uint32_t from = 0;
    std::vector<Point> points;
    glm::dvec3 middle{0.0};
};

std::optional<Ghost> ghost_on(const VesselTree& tree, std::size_t id) {
    constexpr int kLength = 15;
    const std::vector<std::uint32_t>& on = tree.branches[id].points;
    if (on.size() < 5) return std::nullopt;
    Ghost ghost{on[on.size() / 2], {}, {}};
    const Point foot = tree.points[ghost.from];
    const glm::dvec3 along = tree.points[on[on.size() / 2 + 1]].position - tree.points[on[on.size() / 2 - 1]].position;
    const glm::dvec3 side = glm::normalize(
        glm::cross(along, std::abs(along.x) < 0.7 * glm::length(along) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    for (int i = 1; i <= kLength; ++i)
        ghost.points.push_back({foot.position + double(i) * side, std::min(0.6 * foot.radius, 1.5)});
    ghost.middle = foot.position + 0.5 * kLength * side;
    for (const tree::Branch& branch : tree.branches)
        for (const std::uint32_t other : branch.points)
            for (const Point& point : ghost.points) {
                const Point& there = tree.points[other];
                if (glm::distance(point.position, foot.position) > 3.0 * foot.radius + 2.0 &&
                    glm::distance(there.position, point.position) < 2.0 * (there.radius + point.radius))
                    return std::nullopt;
            }
    return ghost;
}

int check_ghosts(const VesselTree& tree, int detail, std::size_t every) {
    int checked = 0;
    for (std::size_t id = 0; id < tree.branches.size(); id += every) {
        const std::optional<Ghost> ghost = ghost_on(tree, id);
        if (!ghost) continue;
        CAPTURE(id);
        const validate::Validation found =
            look_at(tree, damaged_surface(test::with_branch(tree, ghost->from, ghost->points), detail));
        REQUIRE(found.false_parts.size() == 1);
        CHECK(findings(found) == 1);
        CHECK(glm::distance(found.false_parts[0].at, ghost->middle) < kNear);
        CHECK(std::abs(found.false_parts[0].length_mm - 15.0) < kNear);
        ++checked;
    }
    return checked;
}

// How long stenoses are made, in diameters.
double diameters_of(double share) { return share == 0.2 ? 2.0 : share == 0.5 ? 1.0 : 3.0; }

// A place with room for a stenosis of so many diameters, away from the branch's ends, where the radius is even.
std::optional<test::PlaceOn> even_place(const VesselTree& tree, int branch, double diameters) {
    const double whole = tree::length_mm(tree, tree.branches[static_cast<std::size_t>(branch)]);
    for (const double fraction : {0.5, 0.3, 0.7, 0.4, 0.6, 0.2, 0.8}) {
        const test::PlaceOn place{branch, fraction * whole};
        const double middle = test::point_at(tree, place).radius;
        const double half = (diameters + 3.0) * middle;
        if (half > std::min(place.along, whole - place.along)) continue;
        double least = middle, most = middle;
        constexpr int kAsked = 24;
        for (int i = -kAsked; i <= kAsked; ++i) {
            const double radius = test::point_at(tree, {branch, place.along + half * i / kAsked}).radius;
            least = std::min(least, radius);
            most = std::max(most, radius);
        }
        if (most <= 1.1 * least) return place;
    }
    return std::nullopt;
}

// Stenoses of all degrees and lengths, on branches with room for them away from joints, which the surface lacks.
int check_stenoses(const VesselTree& tree, int detail, std::size_t every) {
    const VesselTree healthy = test::dense(tree, 0.25);
    const mesh::TriangleMesh surface = damaged_surface(healthy, detail);
    const std::size_t without = findings(look_at(healthy, surface));
    int checked = 0;
    for (std::size_t id = 0; id < healthy.branches.size(); id += every)
        for (const double share : {0.2, 0.5, 0.8}) {
            const std::optional<test::PlaceOn> place = even_place(healthy, static_cast<int>(id), diameters_of(share));
            if (!place) continue;
            const Point there = test::point_at(healthy, *place);
            const double length = diameters_of(share) * 2.0 * there.radius;
            CAPTURE(id);
            CAPTURE(share);
            const validate::Validation found = look_at(test::with_stenosis(healthy, *place, share, length), surface);
            CHECK(findings(found) == without + 1);
            CHECK(std::ranges::any_of(found.constrictions, [&](const validate::Constriction& one) {
                return one.branch == place->branch && glm::distance(one.at, there.position) < kNear;
            }));
            ++checked;
        }
    return checked;
}

// The branch made to taper from its first point on by `slope`, mm of radius for each mm, about the middle's radius.
VesselTree tapered(VesselTree tree, int branch, double slope) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(branch)].points;
    const double whole = tree::length_mm(tree, tree.branches[static_cast<std::size_t>(branch)]);
    const double middle = test::point_at(tree, {branch, 0.5 * whole}).radius;
    double along = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) along += glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        tree.points[points[i]].radius = middle + slope * (0.5 * whole - along);
    }
    return tree;
}

// A straight vessel that tapers, with a stenosis in its middle that the surface lacks (filled) or has alone (deepened).
void check_on_slope(double slope, double share, double diameters) {
    CAPTURE(slope);
    CAPTURE(share);
    CAPTURE(diameters);
    constexpr double kLength = 80.0, kRadius = 3.0;
    std::vector<Point> points;
    for (double along = 0.0; along <= kLength; along += 0.25)
        points.push_back({{0.1 * along, 0.2 * along, along}, kRadius});
    std::vector<tree::Edge> edges;
    for (std::uint32_t i = 1; i < points.size(); ++i) edges.emplace_back(i - 1, i);
    const VesselTree healthy = tapered(tree::assemble(std::move(points), {}, edges, {0}), 0, slope);
    const test::PlaceOn place{0, 0.5 * tree::length_mm(healthy, healthy.branches[0])};
    const VesselTree narrowed = test::with_stenosis(healthy, place, share, diameters * 2.0 * kRadius);
    CHECK(findings(look_at(healthy, damaged_surface(healthy, kDefaultDetail))) == 0);
    CHECK(findings(look_at(narrowed, damaged_surface(narrowed, kDefaultDetail))) == 0);
    const validate::Validation filled = look_at(narrowed, damaged_surface(healthy, kDefaultDetail));
    REQUIRE(filled.constrictions.size() == 1);
    CHECK(findings(filled) == 1);
    CHECK(glm::distance(filled.constrictions[0].at, test::point_at(healthy, place).position) < kNear);
    CHECK(filled.constrictions[0].radius_mm > 1.1 * filled.constrictions[0].expected_radius_mm);
    if (share >= 0.5) return; // where the surface is half as wide the branch is lost
    const validate::Validation deeper = look_at(healthy, damaged_surface(narrowed, kDefaultDetail));
    REQUIRE(deeper.constrictions.size() == 1);
    CHECK(findings(deeper) == 1);
    CHECK(glm::distance(deeper.constrictions[0].at, test::point_at(healthy, place).position) < kNear);
    CHECK(deeper.constrictions[0].radius_mm < 0.9 * deeper.constrictions[0].expected_radius_mm);
}

// A leaf goes on past another vessel, so near that their tubes overlap by a tenth.
struct Passing {
    VesselTree tree;
    glm::dvec3 at{0.0};
};

std::optional<Passing> passing_on(const VesselTree& tree, int leaf) {
    const std::uint32_t end = tree.branches[static_cast<std::size_t>(leaf)].points.back();
    const Point tip = tree.points[end];
    const tree::Branch& own = tree.branches[static_cast<std::size_t>(leaf)];
    const auto meets = [&](const tree::Branch& other) {
        return other.points.front() == own.points.front() || other.points.back() == own.points.front() ||
               other.points.front() == own.points.back() || other.points.back() == own.points.back();
    };
    double least = std::numeric_limits<double>::infinity();
    int passed = tree::kNoBranch;
    Point beside;
    glm::dvec3 along(0.0);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& other = tree.branches[id];
        if (other.points.size() < 8 || meets(other)) continue;
        const std::size_t i = other.points.size() / 2;
        const double distance = glm::distance(tree.points[other.points[i]].position, tip.position);
        if (distance >= least || distance < 10.0) continue;
        least = distance;
        passed = static_cast<int>(id);
        beside = tree.points[other.points[i]];
        along = glm::normalize(tree.points[other.points[i + 1]].position - tree.points[other.points[i - 1]].position);
    }
    const glm::dvec3 way = glm::normalize(beside.position - tip.position);
    const glm::dvec3 side = glm::cross(way, along);
    if (passed == tree::kNoBranch || glm::length(side) < 0.5) return std::nullopt; // nearly along each other
    const glm::dvec3 through = beside.position + 0.9 * (beside.radius + tip.radius) * glm::normalize(side);
    const glm::dvec3 straight = glm::normalize(through - tip.position);
    std::vector<Point> points;
    const double length = glm::distance(through, tip.position) + 3.0 * beside.radius + 6.0;
    for (double there = 1.0; there < length; there += 1.0)
        points.push_back({tip.position + there * straight, tip.radius});
    // Only this one: what else the leaf comes near on its way would be merged as well.
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        for (const std::uint32_t other : tree.branches[id].points)
            for (const Point& point : points) {
                const Point& there = tree.points[other];
                const bool is_own = static_cast<int>(id) == leaf && glm::distance(point.position, tip.position) < 8.0;
                const bool is_passed = static_cast<int>(id) == passed &&
                                       glm::distance(there.position, through) < 4.0 * (beside.radius + tip.radius);
                if (!is_own && !is_passed &&
                    glm::distance(there.position, point.position) < 1.5 * (there.radius + point.radius) + 1.0)
                    return std::nullopt;
            }
    glm::dvec3 closest(0.0);
    double gap = std::numeric_limits<double>::infinity();
    for (const std::uint32_t other : tree.branches[static_cast<std::size_t>(passed)].points)
        for (const Point& point : points) {
            const Point& there = tree.points[other];
            const double here = glm::distance(there.position, point.position) - there.radius - point.radius;
            if (here < gap) gap = here, closest = 0.5 * (there.position + point.position);
        }
    if (gap > 0.0) return std::nullopt;
    return Passing{test::with_branch(tree, end, points), closest};
}

// Branches that are long, and so far from others that they may be twice as wide, or shifted by 2.5 radii.
std::vector<int> roomy_branches(const VesselTree& tree) {
    std::vector<int> roomy;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const std::vector<std::uint32_t>& own = tree.branches[id].points;
        const Point &first = tree.points[own.front()], &last = tree.points[own.back()];
        double mean = 0.0;
        for (const std::uint32_t p : own) mean += tree.points[p].radius / static_cast<double>(own.size());
        if (own.size() < 5 || tree::length_mm(tree, tree.branches[id]) < 16.0 * mean) continue;
        const auto is_free = [&](const Point& at, const Point& other) {
            const double reach = 3.0 * (first.radius + at.radius);
            return glm::distance(other.position, first.position) < reach ||
                   glm::distance(other.position, last.position) < reach ||
                   glm::distance(other.position, at.position) > 1.6 * other.radius + 6.0 * at.radius + 1.0;
        };
        const auto inner = std::span(own).subspan(1, own.size() - 2);
        bool free = true;
        for (std::size_t other = 0; other < tree.branches.size() && free; ++other)
            for (const std::uint32_t p : tree.branches[other].points)
                free = free && (other == id || std::ranges::all_of(inner, [&](std::uint32_t at) {
                                    return is_free(tree.points[at], tree.points[p]);
                                }));
        if (free) roomy.push_back(static_cast<int>(id));
    }
    return roomy;
}

int check_widths_and_positions(const VesselTree& tree, int most) {
    const std::vector<int> roomy = roomy_branches(tree);
    const std::size_t every = roomy.size() / 3 + 1; // the first and one far from it
    int checked = 0;
    for (std::size_t n = 0; n < roomy.size() && checked < most; n += every, ++checked) {
        const int branch = roomy[n];
        CAPTURE(branch);
        for (const double factor : {2.0, 1.3, 0.7}) {
            CAPTURE(factor);
            const validate::Validation found =
                look_at(tree, damaged_surface(test::scaled_branch(tree, branch, factor), kDefaultDetail));
            REQUIRE_FALSE(found.widths.empty());
            CHECK(findings(found) == found.widths.size());
            for (const validate::Width& one : found.widths) {
                CHECK(one.branch == branch);
                CHECK(one.radius_mm == doctest::Approx(factor * one.expected_radius_mm).epsilon(0.1));
            }
        }
        const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(branch)].points;
        const glm::dvec3 chord = tree.points[points.back()].position - tree.points[points.front()].position;
        const glm::dvec3 side = glm::normalize(glm::cross(
            chord, std::abs(chord.x) < 0.6 * glm::length(chord) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        double radius = 0.0;
        for (const std::uint32_t p : points) radius += tree.points[p].radius / static_cast<double>(points.size());
        for (const double radii : {0.5, 0.9, 1.3, 2.5}) {
            CAPTURE(radii);
            const validate::Validation found = look_at(
                tree, damaged_surface(test::shifted_branch(tree, branch, radii * radius * side), kDefaultDetail));
            REQUIRE(findings(found) > 0);
            CHECK(found.merged.empty());
            CHECK(found.constrictions.empty());
            for (const validate::Lost& one : found.lost) CHECK(one.branch == branch);
            for (const validate::Width& one : found.widths) CHECK(one.branch == branch);
            for (const validate::Offset& one : found.positions) CHECK(one.branch == branch);
            // Within 1.5 radii it is the same branch elsewhere; beyond, one is lost and another false. Radii vary.
            if (radii < 1.0)
                CHECK_FALSE(found.positions.empty());
            else
                CHECK(found.positions.size() + found.lost.size() > 0);
        }
    }
    return checked;
}

} // namespace

TEST_CASE("validation: of a real tree a branch of another width, or elsewhere, is found, and nothing else" *
          doctest::test_suite("slow")) {
    const auto path = test::shared_file("trees", "brain_BG0003.swc");
    if (!path) return;
    const auto tree = io::read_tree(*path);
    REQUIRE(tree);
    CHECK(check_widths_and_positions(*tree, 2) >= 2);
}

TEST_CASE("validation: of a grown tree the leaf that is gone is lost, and no other" * doctest::test_suite("slow")) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(seed);
        check_lost_leaves(test::grown(kGrownBranches, seed), kDefaultDetail, 4);
    }
}

TEST_CASE("validation: on a grown tree a ghost is found in its middle" * doctest::test_suite("slow")) {
    int checked = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(seed);
        checked += check_ghosts(test::grown(kGrownBranches, seed), kDefaultDetail, 3);
    }
    CHECK(checked >= 8);
}

TEST_CASE("validation: on a grown tree filled stenoses are found" * doctest::test_suite("slow")) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(seed);
        CHECK(check_stenoses(test::grown(kGrownBranches, seed), kDefaultDetail, 5) >= 6);
    }
}

// With a slope of 0.05 a stenosis of 20 % over 3 diameters, 18 mm, is no minimum that is 10 %
// below what lies beyond it: 3 - 0.05 * 9 = 2.55 against 2.4 in its middle.
TEST_CASE("validation: filled stenoses of vessels that taper are found" * doctest::test_suite("slow")) {
    for (const double slope : {0.0, 0.02, 0.04, 0.06})
        for (const double share : {0.2, 0.5, 0.8})
            for (const double diameters : {2.0, 3.0, 5.0}) check_on_slope(slope, share, diameters);
}

TEST_CASE("validation: on a grown tree vessels fused by the paper's sum are merged, and apart by default" *
          doctest::test_suite("slow")) {
    int checked = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const VesselTree tree = test::grown(kGrownBranches, seed);
        for (const int leaf : leaves_of(tree)) {
            const std::optional<Passing> passing = passing_on(tree, leaf);
            if (!passing) continue;
            CAPTURE(seed);
            CAPTURE(leaf);
            const validate::Validation found =
                look_at(passing->tree, damaged_surface(passing->tree, kDefaultDetail, mesh::Blend::kPaper));
            REQUIRE(found.merged.size() == 1);
            CHECK(findings(found) == 1);
            CHECK(glm::distance(found.merged[0].at, passing->at) < kNear);
            CHECK(findings(look_at(passing->tree, damaged_surface(passing->tree, kDefaultDetail))) == 0);
            ++checked;
        }
    }
    CHECK(checked >= 4);
}

TEST_CASE("validation: damage of a real tree is found where it is" * doctest::test_suite("slow")) {
    const auto path = test::shared_file("trees", "brain_BG0003.swc");
    if (!path) return;
    const auto tree = io::read_tree(*path);
    REQUIRE(tree);
    check_lost_leaves(*tree, kCoarseDetail, 60);
    CHECK(check_ghosts(*tree, kCoarseDetail, 110) >= 1);
    CHECK(check_stenoses(*tree, kCoarseDetail, 55) >= 2);
    // The paper's sum fuses what the tree keeps apart: all contacts whose tubes overlap clearly, and only contacts.
    const tree::Contacts contacts = tree::find_contacts(tree::prune(*tree, 0.0), tree::limits_of_gaussian(5.0));
    const validate::Validation found = look_at(*tree, damaged_surface(*tree, kCoarseDetail, mesh::Blend::kPaper));
    REQUIRE(found.merged.size() > 5);
    for (const validate::Merged& one : found.merged) {
        CAPTURE(one.branches[0]);
        CAPTURE(one.branches[1]);
        CHECK(std::ranges::any_of(
            contacts.list, [&](const tree::Contact& contact) { return glm::distance(contact.at(), one.at) < kNear; }));
    }
}
