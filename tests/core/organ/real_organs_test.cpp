// Territories in a patient's liver and around a patient's airways against brute force, and trees that are grown in the
// organ of a mask.
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/measure/amount.h"
#include "core/organ/grow_in.h"
#include "core/organ/territories.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "tests/support/nearest_branch.h"
#include "tests/support/shared_data.h"

#include <array>
#include <atomic>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>

using namespace ramus;

namespace {

std::optional<volume::Volume> shared_mask(const std::string& name) {
    const auto path = test::shared_volume(name);
    if (!path) return std::nullopt;
    Job job;
    auto volume = io::read_volume(*path, {}, job);
    REQUIRE(volume);
    return std::move(*volume);
}

organ::Organ whole_organ(const volume::Volume& volume) {
    Job job;
    return organ::organ_of(volume, {}, JobRange(job, 0.0F, 1.0F)).value();
}

// Compares every `every`-th voxel whose two nearest branches differ by more than 1e-4 mm.
void check_against_brute_force(const organ::Organ& organ, const tree::VesselTree& tree, std::size_t every) {
    const std::vector<std::uint8_t> inside = organ::points_in(organ, tree);
    const std::vector<char> ends = measure::free_ends(tree);
    std::vector<std::pair<glm::ivec3, std::size_t>> voxels;
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        if (number % every == 0) voxels.emplace_back(voxel, number);
    });
    Job job;
    for (const organ::Rule rule : {organ::Rule::kTips, organ::Rule::kAxis}) {
        CAPTURE(std::string(organ::name_of(rule)));
        const organ::SupplyOptions options{rule};
        const organ::Supply supply = organ::supply_of(organ, tree, options, {}, JobRange(job, 0.0F, 1.0F)).value();
        std::atomic<std::size_t> wrong = 0, compared = 0;
        tbb::parallel_for(std::size_t{0}, voxels.size(), [&](std::size_t n) {
            const auto& [voxel, number] = voxels[n];
            const test::NearestBranch nearest =
                test::nearest_branch(tree, inside, ends, options, organ.centre_mm(voxel));
            if (nearest.next - nearest.value <= 1e-4) return;
            ++compared;
            if (supply.branch[number] != nearest.branch) ++wrong;
        });
        CHECK(wrong == 0);
        CHECK(compared > 9 * voxels.size() / 10);
        const organ::Grouping grouping = organ::by_system(tree, true);
        std::size_t sum = 0;
        for (const organ::Territory& territory : organ::territories_of(tree, supply, grouping)) sum += territory.voxels;
        CHECK(sum == organ.count());
    }
}

// The voxels of 3 mm within `reach` mm of a tree.
organ::Organ region_around(const tree::VesselTree& tree, double reach) {
    glm::dvec3 least(HUGE_VAL), most(-HUGE_VAL);
    for (const tree::Point& point : tree.points) {
        least = glm::min(least, point.position - reach);
        most = glm::max(most, point.position + reach);
    }
    constexpr double kSide = 3.0;
    const glm::ivec3 size(glm::ceil((most - least) / kSide));
    volume::BitMask mask(size);
    for (const tree::Point& point : tree.points) {
        const glm::ivec3 from(glm::max(glm::ceil((point.position - reach - least) / kSide), glm::dvec3(0.0)));
        const glm::ivec3 to(glm::floor((point.position + reach - least) / kSide));
        for (int k = from.z; k <= to.z && k < size.z; ++k)
            for (int j = from.y; j <= to.y && j < size.y; ++j)
                for (int i = from.x; i <= to.x && i < size.x; ++i)
                    if (glm::distance(least + kSide * glm::dvec3(i, j, k), point.position) < reach) mask.set({i, j, k});
    }
    glm::dmat4 to_patient(kSide);
    to_patient[3] = glm::dvec4(least, 1.0);
    return {std::move(mask), to_patient};
}

// Indices of points in voxels that are not of the organ.
std::vector<std::size_t> points_outside(const organ::Organ& organ, const tree::GrownTree& tree) {
    const glm::dmat4 to_voxel = glm::inverse(organ.to_patient());
    std::vector<std::size_t> outside;
    for (std::size_t n = 0; n < tree.points.size(); ++n) {
        const glm::dvec3 at(to_voxel * glm::dvec4(tree.points[n].position, 1.0));
        if (!organ.mask().test(glm::ivec3(glm::floor(at + 0.5)))) outside.push_back(n);
    }
    return outside;
}

// An ellipsoid on a turned grid of 1.3 x 1 x 2 mm, with a part apart of a few voxels.
organ::Organ ellipsoid(double scale) {
    const glm::ivec3 size(80, 70, 40);
    glm::dmat4 to_patient = glm::rotate(glm::dmat4(1.0), 0.5, glm::normalize(glm::dvec3(1.0, -2.0, 0.7)));
    to_patient = glm::scale(to_patient, scale * glm::dvec3(1.3, -1.0, 2.0));
    to_patient[3] = glm::dvec4(30.0, -80.0, 12.0, 1.0);
    volume::BitMask mask(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 q = (glm::dvec3(i, j, k) - glm::dvec3(40, 35, 20)) / glm::dvec3(34, 30, 17);
                if (glm::dot(q, q) < 1.0 || i + j + k < 3) mask.set({i, j, k});
            }
    return {std::move(mask), to_patient};
}

} // namespace

TEST_CASE("territories in a patient's liver are those of brute force" * doctest::test_suite("slow")) {
    const auto mask = shared_mask("liver_002_organ.nii.gz");
    auto vessels = shared_mask("liver_002_vessels.nii.gz");
    if (!mask || !vessels) return;
    const organ::Organ liver = whole_organ(*mask);
    CHECK(liver.count() == 601'655); // by an independent program
    const std::array<volume::SystemMask, 2> systems{volume::SystemMask{{1}, {}}, volume::SystemMask{{2}, {}}};
    Job job;
    const auto tree = volume::skeletonize(std::move(*vessels), systems, {}, job);
    REQUIRE(tree);
    CHECK(tree->systems.size() == 2);
    check_against_brute_force(liver, *tree, 7);
}

TEST_CASE("territories around a patient's airways are those of brute force" * doctest::test_suite("slow")) {
    const auto path = test::shared_file("trees", "airways_from_mask.swc");
    if (!path) return;
    const auto tree = io::read_tree(*path);
    REQUIRE(tree);
    check_against_brute_force(region_around(*tree, 15.0), *tree, 7);
}

TEST_CASE("a tree grown in a patient's liver stays in it, and its territories are those of brute force" *
          doctest::test_suite("slow")) {
    const auto mask = shared_mask("liver_002_organ.nii.gz");
    if (!mask) return;
    const organ::Organ liver = whole_organ(*mask);
    tree::GrowOptions options = organ::grow_options_for(liver);
    options.branches = 3999;
    Job job;
    auto grown = organ::grow_in(liver, options, job);
    REQUIRE(grown);
    CHECK(grown->organ_volume_mm3 == doctest::Approx(1000.0 * liver.volume_ml()));
    const std::vector<std::size_t> outside = points_outside(liver, *grown);
    for (std::size_t n = 0; n < outside.size(); ++n) CHECK(outside[n] == n); // the beginning of the stem alone
    const tree::VesselTree tree = tree::vessel_tree_of(std::move(*grown));
    CHECK(tree.branches.size() == 3999);
    CHECK(outside.size() < tree.branches[0].points.size());
    check_against_brute_force(liver, tree, 31);
}

TEST_CASE("a tree fills the organ of a mask, whatever its grid and size") {
    for (const double scale : {1.0, 0.05}) {
        CAPTURE(scale);
        const organ::Organ organ = ellipsoid(scale);
        CHECK(organ::part_sizes(organ).size() == 2);
        const organ::Organ part = organ::largest_part(organ);
        CHECK(part.count() == organ::part_sizes(organ).front());
        tree::GrowOptions options = organ::grow_options_for(organ);
        options.branches = 1501;
        options.seed = 3;
        Job job;
        const auto grown = organ::grow_in(organ, options, job);
        REQUIRE(grown);
        CHECK(grown->points.front().radius == doctest::Approx(options.root_radius_mm));
        const std::vector<std::size_t> outside = points_outside(part, *grown);
        CHECK_FALSE(outside.empty());
        for (std::size_t n = 0; n < outside.size(); ++n) CHECK(outside[n] == n);
        const tree::VesselTree tree = tree::vessel_tree_of(tree::GrownTree(*grown));
        CHECK(tree.branches.size() == 1501);
        CHECK(outside.size() < tree.branches[0].points.size());

        // No voxel is far from a leaf: 751 of them share the organ evenly.
        const double fair = std::cbrt(1000.0 * part.volume_ml() / 751.0);
        std::size_t lonely = 0;
        part.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
            if (number % 53 != 0) return;
            double nearest = HUGE_VAL;
            for (const tree::Branch& branch : tree.branches)
                if (branch.children.empty())
                    nearest = std::min(
                        nearest, glm::distance(part.centre_mm(voxel), tree.points[branch.points.back()].position));
            lonely += nearest > 1.8 * fair ? 1 : 0;
        });
        CHECK(lonely < part.count() / 53 / 50);

        const auto again = organ::grow_in(organ, options, job);
        REQUIRE(again);
        REQUIRE(again->points.size() == grown->points.size());
        CHECK(again->points.back().position == grown->points.back().position);
        options.seed = 4;
        const auto other = organ::grow_in(organ, options, job);
        REQUIRE(other);
        CHECK(other->points.back().position != grown->points.back().position);
    }
}

TEST_CASE("an organ without room for a tree is refused") {
    Job job;
    volume::BitMask few({20, 20, 20});
    for (int n = 0; n < 200; ++n) few.set({n % 20, n / 20, 5});
    const organ::Organ small(std::move(few), glm::dmat4(1.0));
    const auto refused = organ::grow_in(small, organ::grow_options_for(small), job);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what == "the organ has 200 voxels");
    CHECK_FALSE(refused.error().hint.empty());

    volume::BitMask flat({100, 100, 3});
    for (int n = 0; n < 10000; ++n) flat.set({n % 100, n / 100, 1});
    const organ::Organ sheet(std::move(flat), glm::dmat4(1.0));
    const auto thin = organ::grow_in(sheet, organ::grow_options_for(sheet), job);
    REQUIRE_FALSE(thin);
    CHECK(thin.error().what.find("too thin") != std::string::npos);
    tree::GrowOptions options = organ::grow_options_for(ellipsoid(1.0));
    options.root_radius_mm = 0.0;
    CHECK_FALSE(organ::grow_in(ellipsoid(1.0), options, job));
}
