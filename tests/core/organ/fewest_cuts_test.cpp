// The fewest cuts that cover a lesion against all sets of cuts, on small random trees and networks.
#include "core/measure/cuts.h"
#include "core/organ/fewest_cuts.h"
#include "core/organ/remnant.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>

using namespace ramus;
using organ::CutSuggestions;
using organ::Supply;

namespace {

// A random tree of about twelve branches, with `loops` more edges.
tree::VesselTree random_network(std::mt19937& random, int loops) {
    std::vector<tree::Point> points{{glm::dvec3(0.0), 1.0}};
    std::vector<tree::Edge> edges;
    for (std::uint32_t n = 1; n < 14; ++n) {
        points.push_back({glm::dvec3(random() % 1000, random() % 1000, n), 1.0});
        edges.emplace_back(n < 3 ? n - 1 : n / 2 + random() % 2, n);
    }
    for (int n = 0; n < loops; ++n) {
        const std::uint32_t a = 1 + random() % 5, b = a + 1 + random() % 5;
        if (std::ranges::find(edges, tree::Edge(a, b)) == edges.end()) edges.emplace_back(a, b);
    }
    return test::built_tree(std::move(points), std::move(edges));
}

struct Random {
    Supply supply;
    std::vector<std::uint8_t> targets, functional;
};

Random random_voxels(std::mt19937& random, int branches) {
    Random voxels;
    const unsigned one_in = 4 + random() % 9;
    for (int b = 0; b < branches; ++b)
        for (unsigned n = 0; n < 1 + random() % 5; ++n) {
            voxels.supply.branch.push_back(b);
            const unsigned place = random() % 6;
            voxels.supply.at.push_back(place == 5 ? 1.0F : static_cast<float>(place) * 0.23F);
            voxels.targets.push_back(random() % one_in == 0 ? 1 : 0);
            voxels.functional.push_back(random() % 5 == 0 ? 0 : 1);
        }
    return voxels;
}

struct Loss {
    std::size_t lost = 0, covered = 0;
};

Loss loss_of(const tree::VesselTree& tree, const Random& voxels, const std::vector<measure::Cut>& cuts) {
    const auto spans = measure::lost_spans(tree, cuts);
    const organ::SystemSupply system{organ::Role::kSupplies, voxels.supply.branch, voxels.supply.at};
    Loss loss;
    for (std::size_t n = 0; n < voxels.targets.size() && !spans.empty(); ++n) {
        if (!organ::is_lost(system, spans, n)) continue;
        loss.lost += voxels.functional[n];
        loss.covered += voxels.targets[n];
    }
    return loss;
}

// By number of cuts, up to 3: the least loss of all sets of cuts of bridges that cover `wanted` targets.
std::vector<std::size_t> least_losses(const tree::VesselTree& tree, const tree::Dependency& dependency,
                                      const Random& voxels, std::size_t wanted) {
    std::vector<measure::Cut> all;
    for (int b = 0; b < dependency.branch_count(); ++b) {
        if (!dependency.is_bridge(b)) continue;
        std::set<double> places{0.0, 0.999, 1.0};
        for (std::size_t n = 0; n < voxels.targets.size(); ++n)
            if (voxels.supply.branch[n] == b) places.insert(static_cast<double>(voxels.supply.at[n]));
        for (const double place : places) all.emplace_back(b, place);
    }
    std::vector<std::size_t> least(4, std::numeric_limits<std::size_t>::max());
    std::vector<measure::Cut> cuts;
    const std::function<void(std::size_t)> choose = [&](std::size_t from) {
        const Loss loss = loss_of(tree, voxels, cuts);
        if (loss.covered == wanted) least[cuts.size()] = std::min(least[cuts.size()], loss.lost);
        for (std::size_t n = from; n < all.size() && cuts.size() < 3; ++n) {
            if (!cuts.empty() && cuts.back().first == all[n].first) continue;
            cuts.push_back(all[n]);
            choose(n + 1);
            cuts.pop_back();
        }
    };
    choose(0);
    return least;
}

} // namespace

TEST_CASE("the fewest cuts lose as little as the best of all sets of cuts") {
    std::mt19937 random(11);
    std::map<std::size_t, int> suggested; // by number of suggestions
    for (int run = 0; run < 150; ++run) {
        CAPTURE(run);
        const tree::VesselTree tree = random_network(random, run % 3);
        const tree::Dependency dependency(tree);
        const Random voxels = random_voxels(random, dependency.branch_count());
        const CutSuggestions found =
            organ::fewest_cuts(dependency, voxels.supply, voxels.targets, voxels.functional, 3);
        CHECK(found.covered + found.out_of_reach == static_cast<std::size_t>(std::ranges::count(voxels.targets, 1)));
        ++suggested[found.by_number.size()];
        if (found.covered == 0) {
            CHECK(found.by_number.empty());
            continue;
        }
        const std::vector<std::size_t> least = least_losses(tree, dependency, voxels, found.covered);
        // Each has the least loss of all sets of at most as many cuts. A number of cuts that saves nothing is left out.
        std::vector<std::size_t> by_number(4, std::numeric_limits<std::size_t>::max());
        for (const organ::SuggestedCuts& one : found.by_number) {
            const Loss loss = loss_of(tree, voxels, one.cuts);
            CHECK(loss.lost == one.lost);
            CHECK(loss.covered == found.covered);
            REQUIRE(one.cuts.size() < 4);
            by_number[one.cuts.size()] = one.lost;
        }
        for (std::size_t n = 1; n < 4; ++n)
            CHECK(*std::min_element(by_number.begin() + 1, by_number.begin() + std::ptrdiff_t(n) + 1) ==
                  *std::min_element(least.begin() + 1, least.begin() + std::ptrdiff_t(n) + 1));
    }
    MESSAGE("cases by number of suggestions: ", suggested[0], " ", suggested[1], " ", suggested[2], " ", suggested[3]);
    CHECK(suggested[2] > 20);
    CHECK(suggested[3] > 5);
}

TEST_CASE("a cut is just before the first voxel that must go, with few digits") {
    const tree::VesselTree tree =
        test::built_tree({{{0, 0, 0}, 1}, {{0, 0, 9}, 1}, {{9, 0, 18}, 1}, {{-9, 0, 18}, 1}}, {{0, 1}, {1, 2}, {1, 3}});
    const tree::Dependency dependency(tree);
    const auto cut = [&](std::vector<float> places, std::vector<std::uint8_t> targets) {
        const std::vector<std::uint8_t> functional(targets.size(), 1);
        const Supply supply{std::vector<std::int32_t>(targets.size(), 1), std::move(places)};
        const CutSuggestions found = organ::fewest_cuts(dependency, supply, targets, functional, 5);
        REQUIRE(found.by_number.size() == 1);
        REQUIRE(found.by_number[0].cuts.size() == 1);
        CHECK(found.by_number[0].cuts[0].first == 1);
        return found.by_number[0].cuts[0].second;
    };
    CHECK(cut({0.2F, 0.47F, 0.9F}, {0, 1, 0}) == 0.4);
    CHECK(cut({0.41F, 0.47F, 0.9F}, {0, 1, 0}) == 0.46);
    CHECK(cut({0.2F, 1.0F, 1.0F}, {0, 1, 0}) == 0.9);
    CHECK(cut({1.0F, 1.0F}, {1, 0}) == 0.0);
    CHECK(cut({0.0F, 1.0F}, {1, 0}) == 0.0);
}

TEST_CASE("voxels near a lesion are those within the margin of its voxels' boxes") {
    volume::BitMask organ_mask({20, 18, 9}), lesion_mask({30, 30, 30});
    for (int k = 0; k < 9; ++k)
        for (int j = 0; j < 18; ++j)
            for (int i = 0; i < 20; ++i)
                if ((i + j + k) % 5 != 0) organ_mask.set({i, j, k});
    const glm::dmat4 to_patient = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 3.0));
    glm::dmat4 to_lesion = glm::translate(glm::dmat4(1.0), glm::dvec3(5.0, -20.0, 8.0));
    to_lesion = glm::scale(glm::rotate(to_lesion, 0.5, glm::dvec3(0.0, 0.0, 1.0)), glm::dvec3(0.7));
    std::vector<glm::ivec3> voxels;
    for (int k = 2; k < 8; ++k)
        for (int j = 12; j < 18; ++j) voxels.insert(voxels.end(), {{10 + j % 3, j, k}, {11 + j % 3, j, k}, {15, j, k}});
    for (const glm::ivec3& voxel : voxels) lesion_mask.set(voxel);
    const organ::Organ organ(std::move(organ_mask), to_patient), lesions(std::move(lesion_mask), to_lesion);
    const glm::dmat4 back = glm::inverse(to_lesion);
    Job job;
    for (const double margin : {0.0, 2.5, 6.0}) {
        const auto near = organ::voxels_near(organ, lesions, margin, JobRange(job, 0.0F, 1.0F));
        std::size_t inside = 0;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
            const glm::dvec3 at(back * glm::dvec4(organ.centre_mm(voxel), 1.0));
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::ivec3& one : voxels)
                nearest = std::min(nearest,
                                   0.7 * glm::length(glm::max(glm::abs(at - glm::dvec3(one)) - 0.5, glm::dvec3(0.0))));
            if (nearest > 0.0 && std::abs(nearest - margin) < 1e-4) return;
            CHECK(near[number] == (nearest <= margin ? 1 : 0));
            inside += near[number];
        });
        CHECK(inside > (margin > 0.0 ? 50U : 3U));
    }
}
