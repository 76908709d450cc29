// Rings in the picture where vessels press on each other.
#include "app/picture/contact_marks.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

constexpr std::size_t kBranches = 1000;

render::Frame frame_before() {
    render::Frame frame;
    frame.size = {800, 600};
    frame.camera.position = {0.0, 300.0, 0.0};
    return frame;
}

// Branches 2n and 2n + 1, at x = 20 n, axes in z.
tree::Contact contact(int n, double gap, double radius) {
    tree::Contact contact;
    contact.gap = gap;
    contact.closeness = 1.0 + gap / (2.0 * radius);
    const double half = 0.5 * contact.closeness * 2.0 * radius;
    contact.sides[0].branch = 2 * n;
    contact.sides[1].branch = 2 * n + 1;
    for (tree::ContactSide& side : contact.sides) side.branches = {side.branch};
    contact.sides[0].at = {20.0 * n, -half, 0.0};
    contact.sides[1].at = {20.0 * n, half, 0.0};
    contact.sides[0].radius = contact.sides[1].radius = radius;
    return contact;
}

} // namespace

TEST_CASE("all contacts have a ring and a number, and overlaps have another ring") {
    const std::vector<tree::Contact> list{contact(0, -8.0, 8.0), contact(1, -0.1, 0.1), contact(2, 0.1, 8.0)};
    render::Frame frame = frame_before();
    mark_contacts(frame, list, ContactMarks::kAll, -1, kBranches, Lengths());
    REQUIRE(frame.lines.size() == 3);
    CHECK(frame.lines[0].colour == frame.lines[1].colour);
    CHECK(frame.lines[0].colour != frame.lines[2].colour);
    for (const glm::dvec3& corner : frame.lines[0].points)
        CHECK(glm::distance(corner, list[0].at()) == doctest::Approx(10.0)); // 1.25 radii
    const auto centre = render::project(frame.camera, frame.size, list[1].at());
    for (const glm::dvec3& corner : frame.lines[1].points) // of thin vessels, 9 pixels
        CHECK(glm::distance(glm::dvec2(*render::project(frame.camera, frame.size, corner)), glm::dvec2(*centre)) ==
              doctest::Approx(9.0).epsilon(0.01));
    REQUIRE(frame.labels.size() == 3);
    CHECK(frame.labels[2].text == "3");
}

TEST_CASE("the current contact is emphasised and has a label, with the other contacts and alone") {
    const std::vector<tree::Contact> list{contact(0, -1.0, 4.0), contact(1, 0.5, 4.0)};
    render::Frame all = frame_before(), alone = frame_before(), none = frame_before();
    mark_contacts(all, list, ContactMarks::kAll, 1, kBranches, Lengths());
    REQUIRE(all.lines.size() == 2);
    CHECK(all.lines[1].width > all.lines[0].width);
    CHECK(all.labels[1].text == "2: gap 0.500 mm");
    mark_contacts(alone, list, ContactMarks::kCurrent, 1, kBranches, Lengths());
    REQUIRE(alone.lines.size() == 1);
    CHECK(alone.lines[0] == all.lines[1]);
    mark_contacts(none, list, ContactMarks::kCurrent, -1, kBranches, Lengths());
    CHECK(none == frame_before());
}

TEST_CASE("contacts of hidden branches are not marked, and many are not numbered") {
    std::vector<tree::Contact> list;
    for (int n = 0; n < static_cast<int>(kMostContactMarks) + 10; ++n) list.push_back(contact(n, -0.1, 1.0));
    render::Frame frame = frame_before();
    frame.states.assign(4, tree::BranchState::kNormal);
    frame.states[1] = tree::BranchState::kHidden;
    mark_contacts(frame, list, ContactMarks::kAll, -1, kBranches, Lengths());
    CHECK(frame.lines.size() == kMostContactMarks - 1);
    CHECK(frame.labels.empty());
    render::Frame last = frame_before();
    mark_contacts(last, list, ContactMarks::kAll, static_cast<int>(list.size()) - 1, kBranches,
                  Lengths()); // though it is beyond them
    CHECK(last.lines.size() == kMostContactMarks + 1);
    CHECK(last.labels.size() == 1);
}

TEST_CASE("the vessels of the current contact have two colours, also while they are selected") {
    const std::vector<tree::Contact> list{contact(0, -1.0, 4.0), contact(1, 0.5, 4.0)};
    render::Frame frame = frame_before();
    frame.selected = {2, 3, 7};
    mark_contacts(frame, list, ContactMarks::kCurrent, 1, kBranches, Lengths());
    REQUIRE(frame.colours.size() == kBranches);
    CHECK(frame.colours[2] != frame.colours[3]);
    CHECK(frame.colours[0] == frame.appearance.vessel);
    CHECK(frame.colours[2] != frame.appearance.vessel);
    CHECK(frame.selected == std::vector<int>{7});
    // Where colours say something along branches they stay.
    render::Frame scaled = frame_before();
    scaled.scale.value = render::ColourScale::Value::kDiameter;
    mark_contacts(scaled, list, ContactMarks::kCurrent, 1, kBranches, Lengths());
    CHECK(scaled.colours.empty());
}
