// The branch that supplies a voxel against brute force in double precision: all segments, all tips, every voxel.
#include "core/measure/amount.h"
#include "core/organ/supply.h"
#include "core/organ/territories.h"
#include "core/tree/grow/grow.h"
#include "tests/support/built_tree.h"
#include "tests/support/nearest_branch.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

using namespace ramus;
using organ::Organ;
using organ::Rule;

namespace {

tree::VesselTree grown(int branches, std::uint64_t seed) {
    Job job;
    tree::GrowOptions options;
    options.branches = branches;
    options.seed = seed;
    return tree::vessel_tree_of(tree::grow(options, job).value());
}

// The voxels of a turned grid of 5 x 4 x 9 mm, the last axis mirrored, that lie in a ball around the middle of the
// tree.
Organ ball_around(const tree::VesselTree& tree, double radius) {
    glm::dvec3 middle(0.0);
    for (const tree::Point& point : tree.points) middle += point.position / static_cast<double>(tree.points.size());
    const glm::ivec3 size(48, 60, 28);
    glm::dmat4 to_patient = glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    to_patient = glm::scale(to_patient, glm::dvec3(5.0, 4.0, -9.0));
    to_patient[3] = glm::dvec4(middle - glm::dvec3(to_patient * glm::dvec4(0.5 * glm::dvec3(size), 0.0)), 1.0);
    volume::BitMask mask(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 at(to_patient * glm::dvec4(i, j, k, 1.0));
                if (glm::distance(at, middle) < radius) mask.set({i, j, k});
            }
    return {std::move(mask), to_patient};
}

} // namespace

TEST_CASE("every voxel belongs to the branch that brute force finds nearest, by each rule") {
    const tree::VesselTree tree = grown(201, 3);
    const Organ organ = ball_around(tree, 70.0);
    const std::vector<std::uint8_t> inside = organ::points_in(organ, tree);
    const std::vector<char> ends = measure::free_ends(tree);
    CHECK(std::ranges::count(inside, 0) > 0); // of a tree that reaches beyond the ball
    Job job;
    for (const Rule rule : {Rule::kTips, Rule::kAxis, Rule::kWall}) {
        CAPTURE(std::string(organ::name_of(rule)));
        const organ::Supply supply = organ::supply_of(organ, tree, {rule}, {}, JobRange(job, 0.0F, 1.0F)).value();
        REQUIRE(supply.branch.size() == organ.count());
        int wrong = 0, compared = 0, number_wrong = 0;
        std::size_t next = 0;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
            number_wrong += number == next++ ? 0 : 1;
            if (number % 31 != 0) return;
            const test::NearestBranch nearest =
                test::nearest_branch(tree, inside, ends, {rule}, organ.centre_mm(voxel));
            if (nearest.next - nearest.value < 1e-4) return;
            ++compared;
            wrong += supply.branch[number] == nearest.branch ? 0 : 1;
        });
        CHECK(number_wrong == 0);
        CHECK(compared > 150);
        CHECK(wrong == 0);
    }
}

TEST_CASE("territories take all voxels of the organ, and none for the stem") {
    const tree::VesselTree tree = grown(101, 5);
    const Organ organ = ball_around(tree, 80.0);
    const tree::Dependency dependency(tree);
    Job job;
    const int left = tree.branches[0].children[0], right = tree.branches[0].children[1];
    for (const organ::Grouping& grouping :
         {organ::by_system(tree), organ::by_generation(tree, 1), organ::by_generation(tree, 3),
          organ::by_branches(tree, dependency, {left, right}), organ::by_branches(tree, dependency, {right})}) {
        const auto supply =
            organ::supply_of(organ, tree, {}, organ::trunk_of(grouping), JobRange(job, 0.0F, 1.0F)).value();
        CHECK(std::ranges::count(supply.branch, 0) == 0); // the stem
        const std::vector<organ::Territory> territories = organ::territories_of(tree, supply, grouping);
        REQUIRE(territories.size() == grouping.names.size());
        std::size_t voxels = 0;
        for (const organ::Territory& territory : territories) voxels += territory.voxels;
        CHECK(voxels == organ.count());
    }
    // The two children of the stem have the same territories by each way of naming them.
    const auto by_generation = organ::by_generation(tree, 1),
               by_branches = organ::by_branches(tree, dependency, {left, right});
    for (std::size_t id = 1; id < tree.branches.size(); ++id)
        CHECK(by_generation.branches[id].group == by_branches.branches[id].group);
}

TEST_CASE("the place on the branch is the fraction of its length") {
    const tree::VesselTree tree =
        test::built_tree({{{0, 0, 0}, 1}, {{10, 0, 0}, 1}, {{10, 30, 0}, 1}}, {{0, 1}, {1, 2}});
    volume::BitMask mask({40, 40, 1});
    for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) mask.set({i, j, 0});
    const Organ organ(std::move(mask), glm::dmat4(1.0));
    Job job;
    const auto supply = organ::supply_of(organ, tree, {Rule::kAxis}, {}, JobRange(job, 0.0F, 1.0F)).value();
    const auto at = [&](int i, int j) { return supply.at[organ.row_start(j, 0) + static_cast<std::size_t>(i)]; };
    CHECK(at(0, 0) == 0.0F);
    CHECK(at(5, 1) == doctest::Approx(5.0 / 40.0));
    CHECK(at(12, 20) == doctest::Approx(30.0 / 40.0));
    CHECK(at(20, 39) == doctest::Approx(1.0));
}

TEST_CASE("parts of an organ that touch by edges alone are apart") {
    volume::BitMask mask({8, 4, 3});
    for (const glm::ivec3& voxel :
         {glm::ivec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 2, 1}, {7, 3, 2}, {6, 3, 2}})
        mask.set(voxel);
    CHECK(organ::part_sizes(Organ(std::move(mask), glm::dmat4(1.0))) == std::vector<std::size_t>{4, 2, 1});
}

TEST_CASE("a tree beside the organ supplies nothing, and that is said") {
    const tree::VesselTree tree = test::built_tree({{{100, 0, 0}, 1}, {{110, 0, 0}, 1}}, {{0, 1}});
    volume::BitMask mask({4, 4, 4});
    mask.set({1, 1, 1});
    Job job;
    const auto supply =
        organ::supply_of(Organ(std::move(mask), glm::dmat4(1.0)), tree, {}, {}, JobRange(job, 0.0F, 1.0F));
    REQUIRE_FALSE(supply);
    CHECK(supply.error().what == "no vessel of the tree lies in the organ");
}
