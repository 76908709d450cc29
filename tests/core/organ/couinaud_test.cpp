#include "core/organ/couinaud.h"
#include "tests/support/built_tree.h"

#include <doctest/doctest.h>
#include <map>

using namespace ramus;

namespace {

// A trunk that forks to the patient's left (x < 0) and right, with a branch to the middle of each segment.
tree::VesselTree liver(bool known_sides) {
    const std::vector<glm::dvec3> middles{{-60, -15, 20}, // 2
                                          {-55, 30, -15}, // 3
                                          {-20, 15, 0},   // 4
                                          {40, 30, -30},  // 5
                                          {60, -40, -30}, // 6
                                          {60, -40, 30},  // 7
                                          {40, 30, 30}};  // 8
    std::vector<tree::Point> points{{{0, -20, -40}, 6.0}, {{0, -10, -10}, 6.0}, {{-20, 0, 0}, 4.0}, {{30, -5, 0}, 5.0}};
    std::vector<tree::Edge> edges{{0, 1}, {1, 2}, {1, 3}};
    for (std::size_t n = 0; n < middles.size(); ++n) {
        const auto head = static_cast<std::uint32_t>(points.size());
        points.push_back({middles[n], 2.0});
        edges.emplace_back(n < 3 ? 2U : 3U, head);
        for (const double side : {-1.0, 1.0}) {
            points.push_back({middles[n] + glm::dvec3(2.0 * side, 5.0 * side, 1.0), 1.0});
            edges.emplace_back(head, static_cast<std::uint32_t>(points.size() - 1));
        }
    }
    tree::VesselTree tree = test::built_tree(points, edges);
    tree.claims.orientation = known_sides ? tree::SaidBy::kFile : tree::SaidBy::kNobody;
    return tree;
}

} // namespace

TEST_CASE("branches are suggested for segments by side and direction") {
    const tree::VesselTree tree = liver(true);
    const auto found = organ::suggested_segments(tree, tree::Dependency(tree), 0);
    REQUIRE(found);
    std::map<int, int> of_segment;
    for (const organ::SegmentSuggestion& one : *found) {
        CHECK(one.tips == 2);
        of_segment[one.segment] = one.branch;
    }
    REQUIRE(found->size() == 7);
    REQUIRE(of_segment.size() == 7);
    for (const auto& [segment, branch] : of_segment) {
        const glm::dvec3 end = tree.points[tree.branches[std::size_t(branch)].points.back()].position;
        CHECK((end.x > 0.0) == (segment > 4));
        if (segment > 4) CHECK((end.y > 0.0) == (segment == 5 || segment == 8));
        if (segment > 4) CHECK((end.z > 0.0) == (segment > 6));
    }
}

TEST_CASE("no segment is suggested where sides are not known, or where nothing forks") {
    const tree::VesselTree unknown = liver(false);
    CHECK_FALSE(organ::suggested_segments(unknown, tree::Dependency(unknown), 0));
    tree::VesselTree tube = test::built_tree({{{0, 0, 0}, 2.0}, {{0, 0, 40}, 2.0}}, {{0, 1}});
    tube.claims.orientation = tree::SaidBy::kFile;
    CHECK_FALSE(organ::suggested_segments(tube, tree::Dependency(tube), 0));
    CHECK_FALSE(organ::suggested_segments(tube, tree::Dependency(tube), 3));
}
