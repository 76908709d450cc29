#include "core/base/box_tree.h"
#include "core/base/eight_boxes.h"

#include <cstddef>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <random>
#include <vector>

using ramus::BoxTree;
using ramus::EightBoxes;

namespace {

// With corners among few places, so that many boxes touch.
EightBoxes::Box some_box(std::mt19937& random) {
    const auto place = [&] { return static_cast<float>(random() % 7U); };
    const glm::vec3 a(place(), place(), place()), b(place(), place(), place());
    return {glm::min(a, b), glm::max(a, b)};
}

unsigned meeting_one_by_one(const EightBoxes& boxes, const EightBoxes::Box& box) {
    unsigned bits = 0;
    for (std::size_t n = 0; n < EightBoxes::kCount; ++n) {
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis)
            meets = meets && boxes.box(n).least[axis] <= box.most[axis] && boxes.box(n).most[axis] >= box.least[axis];
        if (meets) bits |= 1U << n;
    }
    return bits;
}

} // namespace

TEST_CASE("a box meets those of eight boxes that it has a place in common with, touching ones too") {
    std::mt19937 random(1);
    std::size_t some = 0;
    for (int round = 0; round < 1000; ++round) {
        EightBoxes boxes;
        for (std::size_t n = 0; n < EightBoxes::kCount; ++n)
            if (random() % 4U != 0) boxes.set(n, some_box(random)); // the others are around nothing
        const EightBoxes::Box box = some_box(random);
        const unsigned expected = meeting_one_by_one(boxes, box);
        CHECK(boxes.meeting(box) == expected);
        some += expected != 0 && expected != 255U ? 1 : 0;
    }
    CHECK(some > 500);
}

TEST_CASE("boxes around nothing meet no box") {
    CHECK(EightBoxes().meeting({glm::vec3(-1e30F), glm::vec3(1e30F)}) == 0);
}

TEST_CASE("a tree of boxes finds the boxes and the groups of eight that meet a box") {
    std::mt19937 random(2);
    for (const std::size_t count : {0U, 1U, 8U, 9U, 64U, 65U, 700U}) {
        CAPTURE(count);
        std::vector<EightBoxes::Box> boxes(count);
        for (EightBoxes::Box& box : boxes) box = some_box(random);
        const BoxTree tree(BoxTree::level_of(count, [&](std::size_t n) { return boxes[n]; }));
        for (int round = 0; round < 50; ++round) {
            const EightBoxes::Box query = some_box(random);
            const std::size_t first = count > 0 ? random() % (count / 8 + 1) : 0;
            std::vector<std::size_t> expected, found, expected_groups, found_groups;
            std::vector<EightBoxes::Box> around((count + 7) / 8);
            for (std::size_t n = 0; n < count; ++n) {
                if (boxes[n].meets(query)) expected.push_back(n);
                around[n / 8].hold(boxes[n]);
            }
            for (std::size_t group = first; group < around.size(); ++group)
                if (around[group].meets(query)) expected_groups.push_back(group);
            tree.for_each_meeting(query, [&](std::size_t n) { found.push_back(n); });
            tree.for_each_group_meeting(query, first, [&](std::size_t group) { found_groups.push_back(group); });
            CHECK(found == expected);
            CHECK(found_groups == expected_groups);
        }
    }
}

TEST_CASE("a box rounded outward contains the exact one") {
    const ramus::Bounds<glm::dvec3> exact{{0.1, -0.1, 1e-50}, {0.1, 1.0 / 3.0, 1e9 + 1.0}};
    const EightBoxes::Box box = ramus::rounded_outward(exact);
    CHECK(ramus::Bounds<glm::dvec3>{glm::dvec3(box.least), glm::dvec3(box.most)}.contains(exact));
}
