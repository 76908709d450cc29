#include "core/tree/contacts/link_boxes.h"

#include "core/base/morton.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::tree {

namespace {

constexpr float kFar = std::numeric_limits<float>::max();

// A box, rounded outward, around the link's tube, `limit` times as thick.
Bounds<glm::vec3> box_around(const Link& link, double limit) {
    Bounds<glm::dvec3> exact;
    exact.hold(link.a.position, limit * link.a.radius);
    exact.hold(link.b.position, limit * link.b.radius);
    Bounds<glm::vec3> box{glm::vec3(exact.least), glm::vec3(exact.most)};
    for (int axis = 0; axis < 3; ++axis) {
        box.least[axis] = std::nextafter(box.least[axis], -kFar);
        box.most[axis] = std::nextafter(box.most[axis], kFar);
    }
    return box;
}

} // namespace

LinkBoxes::LinkBoxes(const Links& links, double limit) {
    std::vector<Box> boxes(links.all().size());
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t n) { boxes[n] = box_around(links[n], limit); });
    sort_by_place(boxes);
    std::vector<EightBoxes> level((boxes.size() + kFan - 1) / kFan);
    for (std::size_t n = 0; n < boxes.size(); ++n) level[n / kFan].set(n % kFan, boxes[order_[n]]);
    levels_.push_back(std::move(level));
    while (levels_.back().size() > 1) {
        const std::vector<EightBoxes>& below = levels_.back();
        std::vector<EightBoxes> above((below.size() + kFan - 1) / kFan);
        for (std::size_t n = 0; n < below.size(); ++n) above[n / kFan].set(n % kFan, below[n].around());
        levels_.push_back(std::move(above));
    }
}

void LinkBoxes::sort_by_place(const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) all.hold(box);
    const glm::vec3 scale = 1023.0F / glm::max(all.size(), glm::vec3(1e-30F));
    std::vector<std::uint64_t> places(boxes.size()); // Morton code in the high half, index of the link in the low half
    for (std::size_t n = 0; n < boxes.size(); ++n) {
        const glm::uvec3 cell((0.5F * (boxes[n].least + boxes[n].most) - all.least) * scale);
        places[n] = std::uint64_t{morton(cell)} << 32U | n;
    }
    tbb::parallel_sort(places.begin(), places.end());
    order_.resize(boxes.size());
    for (std::size_t n = 0; n < boxes.size(); ++n) order_[n] = static_cast<std::uint32_t>(places[n]);
}

void LinkBoxes::find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const {
    beside.clear();
    if (levels_.size() == 1)
        beside.push_back(0);
    else
        descend(levels_.size() - 1, 0, leaf, levels_.front()[leaf].around(), beside);
}

void LinkBoxes::descend(std::size_t level, std::size_t n, std::size_t leaf, const Box& box,
                        std::vector<std::uint32_t>& beside) const {
    const auto below_bits = static_cast<unsigned>(3 * (level - 1)); // bits of a leaf's number below the child's number
    for (unsigned bits = levels_[level][n].meeting(box); bits != 0; bits &= bits - 1) {
        const std::size_t below = n * kFan + static_cast<std::size_t>(std::countr_zero(bits));
        if (below < leaf >> below_bits) continue;
        if (level == 1)
            beside.push_back(static_cast<std::uint32_t>(below));
        else
            descend(level - 1, below, leaf, box, beside);
    }
}

} // namespace ramus::tree
