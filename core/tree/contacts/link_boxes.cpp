#include "core/tree/contacts/link_boxes.h"

#include "core/base/morton.h"

#include <glm/common.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::tree {

namespace {

using Box = EightBoxes::Box;

// A box around the link's tube, `limit` times as thick.
Box box_around(const Link& link, double limit) {
    Bounds<glm::dvec3> exact;
    exact.hold(link.a.position, limit * link.a.radius);
    exact.hold(link.b.position, limit * link.b.radius);
    return rounded_outward(exact);
}

// The indices of the boxes in Morton order.
std::vector<std::uint32_t> in_order(const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) all.hold(box);
    const glm::vec3 scale = 1023.0F / glm::max(all.size(), glm::vec3(1e-30F));
    std::vector<std::uint64_t> places(boxes.size()); // Morton code in the high half, index of the link in the low half
    for (std::size_t n = 0; n < boxes.size(); ++n) {
        const glm::uvec3 cell((0.5F * (boxes[n].least + boxes[n].most) - all.least) * scale);
        places[n] = std::uint64_t{morton(cell)} << 32U | n;
    }
    tbb::parallel_sort(places.begin(), places.end());
    std::vector<std::uint32_t> order(boxes.size());
    for (std::size_t n = 0; n < boxes.size(); ++n) order[n] = static_cast<std::uint32_t>(places[n]);
    return order;
}

BoxTree sorted_boxes(const Links& links, double limit, std::vector<std::uint32_t>& order) {
    std::vector<Box> boxes(links.size());
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t n) { boxes[n] = box_around(links[n], limit); });
    order = in_order(boxes);
    return BoxTree(BoxTree::level_of(boxes.size(), [&](std::size_t n) { return boxes[order[n]]; }));
}

} // namespace

LinkBoxes::LinkBoxes(const Links& links, double limit) : tree_(sorted_boxes(links, limit, order_)) {}

void LinkBoxes::find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const {
    beside.clear();
    tree_.for_each_group_meeting(tree_.levels().front()[leaf].around(), leaf,
                                 [&](std::size_t other) { beside.push_back(static_cast<std::uint32_t>(other)); });
}

} // namespace ramus::tree
