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

// The links in the Morton order of their boxes' middles.
LargeArray<std::uint32_t> in_order(const Links& links, double limit, const LargeAllocator<std::byte>& memory) {
    Box all;
    for (std::size_t n = 0; n < links.size(); ++n) all.hold(box_around(links[n], limit));
    const glm::vec3 scale = 1023.0F / glm::max(all.size(), glm::vec3(1e-30F));
    LargeArray<std::uint64_t> places(links.size(), memory); // Morton code in the high half, the link in the low half
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
        const Box box = box_around(links[n], limit);
        const glm::uvec3 cell((0.5F * (box.least + box.most) - all.least) * scale);
        places[n] = std::uint64_t{morton(cell)} << 32U | n;
    });
    tbb::parallel_sort(places.begin(), places.end());
    LargeArray<std::uint32_t> order(links.size(), memory);
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = static_cast<std::uint32_t>(places[n]);
    return order;
}

} // namespace

// Boxes are computed again where they are needed, since those of all links in their own order would take as much memory
// as the tree of boxes.
LinkBoxes::LinkBoxes(const Links& links, double limit, const LargeAllocator<std::byte>& memory)
    : order_(in_order(links, limit, memory)),
      tree_(BoxTree::level_of(
          links.size(), [&](std::size_t n) { return box_around(links[order_[n]], limit); }, memory)) {}

void LinkBoxes::find_beside(std::size_t leaf, std::vector<std::uint32_t>& beside) const {
    beside.clear();
    tree_.for_each_group_meeting(tree_.levels().front()[leaf].around(), leaf,
                                 [&](std::size_t other) { beside.push_back(static_cast<std::uint32_t>(other)); });
}

} // namespace ramus::tree
