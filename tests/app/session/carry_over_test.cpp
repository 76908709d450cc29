// Marks and the view stay with the vessels when their file is read in another way.
#include "app/session/carry_over.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/two_systems.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// A trunk that forks; and 12 mm from there, without a parent, a vessel of its own.
constexpr const char* kFork = "1 0 0 0 0 5 -1\n2 0 0 0 40 5 1\n3 0 30 0 60 3 2\n4 0 -30 0 60 3 2\n";
constexpr const char* kOrphan = "5 0 0 90 0 2 77\n6 0 0 99 0 2 5\n";

tree::VesselTree read(const std::string& swc, const char* unit = nullptr,
                      io::Orientation orientation = io::Orientation::ras()) {
    io::ReadOptions options;
    options.repair = tree::Repair::kAll;
    options.orientation = orientation;
    if (unit != nullptr) options.unit = io::length_unit(unit);
    auto tree = io::parse_tree(swc, "t.swc", options);
    REQUIRE(tree);
    return std::move(*tree);
}

// In front of the fork, looking at one of its ends.
render::Camera camera_at_work() {
    render::Camera camera;
    camera.position = {10.0, 200.0, 30.0};
    camera.focal_point = {30.0, 0.0, 60.0};
    camera.scale = 50.0;
    return camera;
}

} // namespace

TEST_CASE("branches are matched by equal shape, otherwise by equal position") {
    const auto fork = read(kFork);
    CHECK(same_branches(fork, read(kFork, "cm")) == std::vector<int>{0, 1, 2});
    const auto more = read(std::string(kFork) + kOrphan);
    const std::vector<int> there = same_branches(fork, more), back = same_branches(more, fork);
    REQUIRE(there.size() == 3);
    int lost = 0;
    for (std::size_t id = 0; id < there.size(); ++id) CHECK(back[static_cast<std::size_t>(there[id])] == int(id));
    for (const int id : back) lost += id == tree::kNoBranch ? 1 : 0;
    CHECK(lost == 1);
}

TEST_CASE("marks are carried over with their branches, and lost marks are counted") {
    const auto more = read(std::string(kFork) + kOrphan), fork = read(kFork);
    const std::vector<int> same = same_branches(more, fork);
    const auto lone = static_cast<int>(std::ranges::find(same, tree::kNoBranch) - same.begin());
    const int kept = lone == 0 ? 1 : 0;
    const int now = same[static_cast<std::size_t>(kept)];
    Marks marks;
    marks.selection = canonical({lone, kept});
    set_state(marks, std::vector{lone, kept}, tree::BranchState::kHidden);
    marks.cuts = {{kept, 0.25}, {lone, 0.5}};
    marks.names = {{kept, "portal"}, {lone, "else"}};
    marks.lesions = {{.sphere = {1, 2, 3, 4}}};
    marks.measurements = {{.kind = Measurement::Kind::kPath, .places = {{{kept, 0.5}, {lone, 0.5}}}},
                          {.kind = Measurement::Kind::kDiameter, .places = {{{kept, 0.5}}}}};
    const CarriedOver carried = carried_over(marks, BranchMap::read_again(more, fork));
    CHECK(carried.marks.selection == std::vector<int>{now});
    CHECK(branches_in_state(carried.marks, tree::BranchState::kHidden) == std::vector<int>{now});
    CHECK(carried.marks.cuts == std::vector<std::pair<int, double>>{{now, 0.25}});
    CHECK(carried.marks.names == std::map<int, std::string>{{now, "portal"}});
    CHECK(carried.marks.measurements.size() == 1);
    CHECK(carried.marks.lesions == marks.lesions);
    CHECK(carried.lost == 5); // selection, state, cut, name, an end of a path
}

TEST_CASE("a hidden system stays hidden even if its branches change; names of systems that the tree lacks are lost") {
    const auto before = test::two_systems();
    auto after = before;
    for (tree::Point& point : after.points) point.position += 0.25; // no branch is where one was
    after.branches.pop_back();
    after.branches.push_back(before.branches[3]);
    after.branches.push_back(before.branches[3]); // the hepatic vein in two
    Marks marks;
    set_state(marks, std::vector{1, 3}, tree::BranchState::kHidden);
    marks.systems = before.systems;
    marks.systems[0].name = "V. portae";
    const CarriedOver carried = carried_over(marks, BranchMap::read_again(before, after));
    CHECK(branches_in_state(carried.marks, tree::BranchState::kHidden) == std::vector<int>{3, 4});
    CHECK(carried.lost == 1);
    CHECK(carried.marks.systems == marks.systems);
    auto plain = after;
    plain.systems.clear();
    for (tree::Branch& branch : plain.branches) branch.system = 0;
    marks.colour_by = ColourBy::kSystem;
    const CarriedOver together = carried_over(marks, BranchMap::read_again(before, plain));
    CHECK(together.marks.systems.empty());
    CHECK(together.marks.colour_by.kind == ColourBy::kNothing);
    CHECK(carried_over(together.marks, BranchMap::read_again(plain, before)).marks.colour_by.kind == ColourBy::kSystem);
}

TEST_CASE("a mask that is used for both tree and isosurface has one unit") {
    Marks marks;
    marks.comparison.mask = "/a/mask.nii";
    marks.reading.unit = io::length_unit("cm");
    follow_unit(marks, {"/a/other.nii", ""});
    CHECK(marks.comparison.mask_units.empty());
    follow_unit(marks, {"/a/mask.nii", ""});
    CHECK(marks.comparison.mask_units == "cm");
    marks.reading.unit.reset();
    follow_unit(marks, {"/a/mask.nii", ""});
    CHECK(marks.comparison.mask_units.empty());
}

TEST_CASE("the camera shows the same part of a tree after a change of unit or axes") {
    const auto fork = read(kFork), in_cm = read(kFork, "cm"), turned = read(kFork, nullptr, io::Orientation::lps());
    const render::Camera camera = camera_at_work();
    const glm::ivec2 size(400, 300);
    const render::Camera scaled = carried_over(camera, fork, in_cm);
    for (std::size_t p = 0; p < fork.points.size(); ++p) {
        const auto before = render::project(camera, size, fork.points[p].position);
        const auto after = render::project(scaled, size, in_cm.points[p].position);
        REQUIRE((before && after));
        CHECK(before->x == doctest::Approx(after->x));
        CHECK(before->y == doctest::Approx(after->y));
    }
    CHECK(scaled.scale == doctest::Approx(500.0));
    const render::Camera behind = carried_over(camera, fork, turned);
    for (std::size_t p = 0; p < fork.points.size(); ++p) {
        const auto before = render::project(camera, size, fork.points[p].position);
        const auto after = render::project(behind, size, turned.points[p].position);
        REQUIRE((before && after));
        CHECK(before->x == doctest::Approx(after->x));
        CHECK(before->y == doctest::Approx(after->y));
    }
    CHECK(carried_over(camera, fork, fork) == camera);
}
