// Labels of a mask that become systems of a tree.
#include "core/volume/skeletonize/skeletonize.h"
#include "tests/support/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <set>

using namespace ramus;

namespace {

constexpr glm::ivec3 kSize(60, 24, 16);

// Two tubes that touch, labels 3 and 7.
volume::Volume two_tubes() {
    volume::Volume volume;
    volume.size = kSize;
    SparseArray<std::uint8_t> labels(static_cast<std::size_t>(kSize.x) * kSize.y * kSize.z, 0);
    for (int k = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 3; i < kSize.x - 3; ++i) {
                auto& label = labels[static_cast<std::size_t>(i + kSize.x * (j + kSize.y * k))];
                if (std::hypot(j - 7.0, k - 8.0) <= 4.0) label = 3;
                if (std::hypot(j - 15.0, k - 8.0) <= 4.0) label = 7;
            }
    volume.voxels = std::move(labels);
    volume.maximum = 7.0;
    return volume;
}

using Groups = volume::LabelGroups::value_type;

tree::VesselTree tree_of(const volume::LabelGroups& groups, std::vector<volume::LabelName> names = {}) {
    volume::Volume volume = two_tubes();
    volume.label_names = std::move(names);
    const auto systems = volume::systems_of(volume, groups);
    REQUIRE(systems);
    Job job;
    auto tree = volume::skeletonize(std::move(volume), *systems, {}, job);
    REQUIRE(tree);
    return std::move(*tree);
}

} // namespace

TEST_CASE("each label is a system that is joined with no other, though they touch") {
    const tree::VesselTree apart = tree_of(Groups{});
    CHECK(apart.roots.size() == 2);
    REQUIRE(apart.systems.size() == 2);
    CHECK(apart.systems[0].name == "label 3");
    CHECK(apart.systems[1].name == "label 7");
    CHECK(apart.systems[0].colour != apart.systems[1].colour);
    for (const tree::Branch& branch : apart.branches)
        for (const std::uint32_t point : branch.points)
            CHECK(apart.points[point].position.y == doctest::Approx(branch.system == 0 ? 7.0 : 15.0).epsilon(0.03));

    CHECK(tree_of(std::nullopt).roots.size() == 1);
    CHECK(tree_of(std::nullopt).systems.empty());
    CHECK(tree_of(Groups{{3, 7}}).roots.size() == 1);
    const tree::VesselTree named = tree_of(Groups{{7}}, {{3, "portal vein"}, {7, "hepatic vein"}});
    REQUIRE(named.systems.size() == 1);
    CHECK(named.systems[0].name == "hepatic vein");
    CHECK(tree_of(Groups{{7}}).systems.empty());
}

TEST_CASE("systems of a mask of many labels have colours of their own") {
    constexpr int kLabels = 24;
    volume::Volume volume = two_tubes();
    volume.size = {20, 8 * kLabels, 8};
    SparseArray<std::uint8_t> voxels(static_cast<std::size_t>(volume.size.x) * volume.size.y * volume.size.z, 0);
    for (int z = 2; z < 6; ++z)
        for (int y = 0; y < volume.size.y; ++y)
            for (int x = 2; x < 18; ++x)
                if (y % 8 >= 2 && y % 8 < 6)
                    voxels[static_cast<std::size_t>(x + volume.size.x * (y + volume.size.y * z))] =
                        static_cast<std::uint8_t>(1 + y / 8);
    volume.voxels = std::move(voxels);
    volume.maximum = kLabels;
    const auto systems = volume::systems_of(volume, volume::LabelGroups(Groups()));
    REQUIRE(systems);
    Job job;
    const auto tree = volume::skeletonize(std::move(volume), *systems, {}, job);
    REQUIRE(tree);
    REQUIRE(tree->systems.size() == kLabels);
    std::set<std::array<std::uint8_t, 3>> colours;
    for (const tree::System& system : tree->systems) colours.insert(system.colour);
    CHECK(colours.size() == kLabels);
}

TEST_CASE("labels that are not there, or twice, and scans are refused") {
    const volume::Volume volume = two_tubes();
    CHECK(volume::systems_of(volume, Groups{{5}}).error().what == "no voxel has label 5");
    CHECK(volume::systems_of(volume, Groups{{3}, {7, 3}}).error().what == "label 3 is given twice");
    volume::Volume scan = two_tubes();
    SparseArray<std::int16_t> grey(static_cast<std::size_t>(kSize.x) * kSize.y * kSize.z, 0);
    for (std::size_t n = 0; n < grey.size(); ++n) grey[n] = static_cast<std::int16_t>(n % 900);
    scan.voxels = std::move(grey);
    scan.maximum = 899.0;
    for (const volume::LabelGroups& groups : {volume::LabelGroups(), volume::LabelGroups(Groups())})
        CHECK(volume::systems_of(scan, groups).error().what.find("looks like a scan") != std::string::npos);
}
