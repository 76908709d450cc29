// What a grown tree promises (core/tree/grow/grow.h), checked on its points alone, with code of its own: branches are
// found again from the parents, touching vessels by comparing everything with everything near.
#include "core/tree/grow/grow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

using namespace ramus;
using namespace ramus::tree;

namespace {

struct Grown : GrownTree {
    std::vector<int> child_count; // of each point
    std::vector<int> branch_of;   // of the edge from the parent to each point, named by its last point
    std::vector<int> ends;        // last point of each branch
};

Grown grown(const GrowOptions& options) {
    Job job;
    Result<GrownTree> result = grow(options, job);
    REQUIRE(result.has_value());
    Grown tree{*result, {}, {}, {}};
    const std::size_t count = tree.points.size();
    REQUIRE(tree.parents.size() == count);
    REQUIRE(tree.parents[0] == -1);
    tree.child_count.assign(count, 0);
    for (std::size_t i = 1; i < count; ++i) {
        REQUIRE(tree.parents[i] >= 0);
        REQUIRE(tree.parents[i] < static_cast<int>(i));
        ++tree.child_count[static_cast<std::size_t>(tree.parents[i])];
    }
    tree.branch_of.assign(count, -1);
    for (std::size_t i = count; i-- > 1;) {
        if (tree.child_count[i] != 1) {
            tree.branch_of[i] = static_cast<int>(i);
            tree.ends.push_back(static_cast<int>(i));
        }
        const auto parent = static_cast<std::size_t>(tree.parents[i]);
        if (parent > 0 && tree.child_count[parent] == 1) tree.branch_of[parent] = tree.branch_of[i];
    }
    return tree;
}

GrowOptions of(int branches, std::uint64_t seed = 1) {
    GrowOptions options;
    options.branches = branches;
    options.seed = seed;
    return options;
}

double cubed(double x) { return x * x * x; }

double distance_of_segments(glm::dvec3 p, glm::dvec3 q, glm::dvec3 r, glm::dvec3 s) {
    // The convex quadratic's minimum over the unit square: inside, or on one of the four sides.
    const auto to_segment = [](glm::dvec3 x, glm::dvec3 a, glm::dvec3 b) {
        const double t = std::clamp(glm::dot(x - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        return glm::length(x - a - t * (b - a));
    };
    double best = std::min({to_segment(p, r, s), to_segment(q, r, s), to_segment(r, p, q), to_segment(s, p, q)});
    const glm::dvec3 u = q - p;
    const glm::dvec3 v = s - r;
    const glm::dvec3 n = glm::cross(u, v);
    const double nn = glm::dot(n, n);
    if (nn > 1e-12) {
        const double a = glm::dot(glm::cross(r - p, v), n) / nn;
        const double b = glm::dot(glm::cross(r - p, u), n) / nn;
        if (a >= 0 && a <= 1 && b >= 0 && b <= 1) best = std::min(best, std::abs(glm::dot(r - p, n)) / std::sqrt(nn));
    }
    return best;
}

// Length of the way along the tree between two points.
double way(const Grown& tree, std::size_t a, std::size_t b) {
    double total = 0.0;
    while (a != b) {
        if (a < b) std::swap(a, b); // parents come first, so the later one is not an ancestor of the other
        const auto parent = static_cast<std::size_t>(tree.parents[a]);
        total += glm::length(tree.points[a].position - tree.points[parent].position);
        a = parent;
    }
    return total;
}

// Pairs of edges that touch although the way between them is too long for a joint.
int forbidden_contacts(const Grown& tree) {
    double longest = 0.0;
    double widest = 0.0;
    const auto radius = [&](std::size_t i) {
        return tree.points[static_cast<std::size_t>(tree.branch_of[i])].radius; // one along the branch
    };
    for (std::size_t i = 1; i < tree.points.size(); ++i) {
        const auto parent = static_cast<std::size_t>(tree.parents[i]);
        longest = std::max(longest, glm::length(tree.points[i].position - tree.points[parent].position));
        widest = std::max(widest, radius(i));
    }
    // Edges by the cube their end lies in, so large that what touches lies in neighbouring ones.
    const double cell = 2.0 * widest + 2.0 * longest;
    const auto key = [&](const glm::dvec3& p) {
        return std::array<int, 3>{static_cast<int>(std::floor(p.x / cell)), static_cast<int>(std::floor(p.y / cell)),
                                  static_cast<int>(std::floor(p.z / cell))};
    };
    std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
    for (std::size_t i = 1; i < tree.points.size(); ++i) cells[key(tree.points[i].position)].push_back(i);
    int contacts = 0;
    for (std::size_t i = 1; i < tree.points.size(); ++i) {
        const auto at = key(tree.points[i].position);
        for (int n = 0; n < 27; ++n) {
            const auto found = cells.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
            if (found == cells.end()) continue;
            for (const std::size_t k : found->second) {
                if (k >= i) continue;
                const double sum = radius(i) + radius(k);
                const glm::dvec3& i_end = tree.points[i].position;
                const glm::dvec3& k_end = tree.points[k].position;
                if (glm::length(i_end - k_end) > sum + 2.0 * longest) continue;
                const auto i_start = static_cast<std::size_t>(tree.parents[i]);
                const auto k_start = static_cast<std::size_t>(tree.parents[k]);
                if (distance_of_segments(tree.points[i_start].position, i_end, tree.points[k_start].position, k_end) >=
                    sum)
                    continue;
                // From end to end the way may be longer than between the nearest places, by both edges at most.
                if (way(tree, i, k) > kJointReach * sum + 2.0 * longest) ++contacts;
            }
        }
    }
    return contacts;
}

std::uint64_t fingerprint(const GrownTree& tree) {
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    const auto take = [&](double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x100000001B3ULL;
    };
    for (std::size_t i = 0; i < tree.points.size(); ++i) {
        const auto& [position, radius] = tree.points[i];
        for (const double value : {position.x, position.y, position.z, radius, static_cast<double>(tree.parents[i])})
            take(value);
    }
    return hash;
}

} // namespace

TEST_CASE("a grown tree has exactly the branches asked for" * doctest::test_suite("slow")) {
    for (const int branches : {1, 3, 4, 5, 6, 7, 8, 9, 10, 31, 32, 99, 100, 1503, 1504}) {
        CAPTURE(branches);
        const Grown tree = grown(of(branches));
        CHECK(tree.ends.size() == static_cast<std::size_t>(branches));
        CHECK(tree.child_count[0] == 1);
        // An even number needs one threefold fork; nothing else is not twofold.
        const auto threefold =
            std::count_if(tree.child_count.begin(), tree.child_count.end(), [](int c) { return c > 2; });
        CHECK(threefold == (branches % 2 == 0 ? 1 : 0));
    }
}

TEST_CASE("Murray's law holds at every fork of a grown tree, and the stem has the radius asked for") {
    GrowOptions options = of(1504, 3);
    options.root_radius_mm = 6.5;
    const Grown tree = grown(options);
    CHECK(tree.points[0].radius == doctest::Approx(6.5).epsilon(1e-12));
    std::map<int, double> children_cubed; // by the fork's point
    for (std::size_t i = 1; i < tree.points.size(); ++i) {
        const int fork = tree.parents[i];
        const int branch = tree.branch_of[i];
        if (fork > 0 && tree.child_count[static_cast<std::size_t>(fork)] > 1)
            children_cubed[fork] += cubed(tree.points[i].radius);
        // One radius along a branch and at its end.
        CHECK(tree.points[i].radius == tree.points[static_cast<std::size_t>(branch)].radius);
    }
    CHECK(children_cubed.size() == 751); // 753 leaves need 752 twofold forks; two of them are merged into one
    for (const auto& [fork, sum] : children_cubed) {
        const double parent = cubed(tree.points[static_cast<std::size_t>(fork)].radius);
        CHECK(std::abs(sum - parent) <= 1e-9 * parent);
    }
}

TEST_CASE("vessels of a grown tree touch at joints only" * doctest::test_suite("slow")) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) CHECK(forbidden_contacts(grown(of(1504, seed))) == 0);
    CHECK(forbidden_contacts(grown(of(100, 9))) == 0);
    GrowOptions winding = of(501, 5);
    winding.tortuosity = 2.0;
    CHECK(forbidden_contacts(grown(winding)) == 0);
}

TEST_CASE("the check for touching vessels finds a vessel that was moved onto another") {
    Grown tree = grown(of(301, 1));
    // Lay the last leaf's tip onto the stem.
    const auto tip = static_cast<std::size_t>(tree.ends.front());
    tree.points[tip].position = tree.points[3].position;
    CHECK(forbidden_contacts(tree) > 0);
}

TEST_CASE("a grown tree stays inside the organ, and its stem comes from outside") {
    const GrowOptions options = of(1504, 2);
    const Grown tree = grown(options);
    const std::vector<double> depths = organ_depths_mm(options, tree.points);
    CHECK(depths[0] < 0.0);
    const auto stem = static_cast<std::size_t>(tree.branch_of[1]);
    for (std::size_t i = stem; i < depths.size(); ++i) CHECK(depths[i] > 0.0);
    CHECK(tree.organ_volume_mm3 == doctest::Approx(1.5e6).epsilon(0.1));
}

TEST_CASE("terminals of a grown tree fill the organ evenly") {
    const GrowOptions options = of(3001, 4);
    const Grown tree = grown(options);
    std::vector<glm::dvec3> leaves;
    glm::dvec3 low(1e9);
    glm::dvec3 high(-1e9);
    for (const int end : tree.ends) {
        const glm::dvec3& at = tree.points[static_cast<std::size_t>(end)].position;
        if (tree.child_count[static_cast<std::size_t>(end)] > 0) continue;
        leaves.push_back(at);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    REQUIRE(leaves.size() == 1501);
    // Spacing of a perfectly even filling: one terminal per volume / count.
    const double fair = std::cbrt(tree.organ_volume_mm3 / static_cast<double>(leaves.size()));
    for (std::size_t i = 0; i < leaves.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) REQUIRE(glm::length(leaves[i] - leaves[k]) > 0.35 * fair);

    // No hole: places deep enough in the organ have a vessel's end near.
    std::vector<Point> places;
    constexpr int kSteps = 24;
    for (int n = 0; n < kSteps * kSteps * kSteps; ++n) {
        const glm::dvec3 step(n % kSteps, n / kSteps % kSteps, n / kSteps / kSteps);
        places.push_back({low + (high - low) * (step + 0.5) / double(kSteps), 1.0});
    }
    const std::vector<double> depths = organ_depths_mm(options, places);
    int inside = 0;
    int lonely = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (depths[i] < 0.3 * fair) continue;
        ++inside;
        double nearest = 1e9;
        for (const glm::dvec3& leaf : leaves) nearest = std::min(nearest, glm::length(leaf - places[i].position));
        lonely += nearest > 1.6 * fair ? 1 : 0;
    }
    CHECK(inside > 3000);
    CHECK(lonely < inside / 100);
}

TEST_CASE("points of a grown tree lie as densely as asked, on centerlines without kinks") {
    GrowOptions options = of(301, 1);
    options.spacing_mm = 0.5;
    const Grown tree = grown(options);
    std::vector<double> length(tree.points.size(), 0.0); // of the branch, at its last point
    for (std::size_t i = 1; i < tree.points.size(); ++i)
        length[static_cast<std::size_t>(tree.branch_of[i])] +=
            glm::length(tree.points[i].position - tree.points[static_cast<std::size_t>(tree.parents[i])].position);
    int turns = 0;
    int sharp = 0;
    for (std::size_t i = 1; i < tree.points.size(); ++i) {
        const auto before = static_cast<std::size_t>(tree.parents[i]);
        const glm::dvec3 step = tree.points[i].position - tree.points[before].position;
        CHECK(glm::length(step) > 0.0);
        if (length[static_cast<std::size_t>(tree.branch_of[i])] > 2.0) {
            CHECK(glm::length(step) > 0.7 * options.spacing_mm);
            CHECK(glm::length(step) < 1.3 * options.spacing_mm);
        }
        if (before == 0 || tree.child_count[before] != 1) continue;
        const glm::dvec3 last =
            tree.points[before].position - tree.points[static_cast<std::size_t>(tree.parents[before])].position;
        ++turns;
        sharp += glm::dot(glm::normalize(step), glm::normalize(last)) < 0.9 ? 1 : 0; // 26 degrees
    }
    CHECK(turns > 5000);
    CHECK(sharp == 0);
}

TEST_CASE("growing is repeatable to the last bit, and the seed matters") {
    const std::uint64_t first = fingerprint(grown(of(1504, 7)));
    CHECK(first == fingerprint(grown(of(1504, 7))));
    CHECK(first != fingerprint(grown(of(1504, 8))));
}

TEST_CASE("thirty thousand branches keep every promise" * doctest::test_suite("slow")) {
    const Grown tree = grown(of(30000, 1));
    CHECK(tree.ends.size() == 30000);
    CHECK(forbidden_contacts(tree) == 0);
}

TEST_CASE("options that cannot be grown are refused with a remedy") {
    Job job;
    for (const int branches : {-5, 0, 2, kMaxGrownBranches + 1}) CHECK_FALSE(grow(of(branches), job).has_value());
    GrowOptions options = of(101);
    options.root_radius_mm = std::nan("");
    CHECK_FALSE(grow(options, job).has_value());
    options = of(101);
    options.spacing_mm = 0.0;
    const auto refused = grow(options, job);
    REQUIRE_FALSE(refused.has_value());
    CHECK_FALSE(refused.error().what.empty());
    CHECK_FALSE(refused.error().hint.empty());
    job.cancel();
    CHECK_FALSE(grow(of(101), job).has_value());
}
