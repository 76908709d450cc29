#include "core/base/eight_boxes.h"

#include <cstddef>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <random>

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
