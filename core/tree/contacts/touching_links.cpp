#include "core/tree/contacts/touching_links.h"

#include "core/tree/contacts/along_tree.h"
#include "core/tree/contacts/link_boxes.h"

#include <algorithm>
#include <bit>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::tree {

namespace {

struct Found {
    std::uint32_t low = 0;
    TouchingLinks::Other other;
};

// A cheap conservative test before closest_approach(): whether the bounding spheres of the two tubes, `limit` times as
// thick, intersect.
bool may_touch(const Link& a, const Link& b, double limit) {
    const double lengths = glm::distance(a.a.position, a.b.position) + glm::distance(b.a.position, b.b.position);
    const double radii = std::max(a.a.radius, a.b.radius) + std::max(b.a.radius, b.b.radius);
    const glm::dvec3 between = 0.5 * (a.a.position + a.b.position) - 0.5 * (b.a.position + b.b.position);
    const double most = 1.000001 * (0.5 * lengths + limit * radii);
    return glm::dot(between, between) <= most * most;
}

// Scratch data of one thread.
struct Search {
    AlongTree along;
    std::vector<std::uint32_t> beside; // leaves
};

// Finds all touching pairs of the links of one leaf with links of the same or later leaves.
void find_pairs(const Links& links, const LinkBoxes& boxes, std::size_t leaf, double limit, Search& search,
                std::vector<Found>& found) {
    constexpr std::size_t kFan = LinkBoxes::kFan;
    boxes.find_beside(leaf, search.beside);
    for (std::size_t place = leaf * kFan; place < std::min((leaf + 1) * kFan, boxes.size()); ++place) {
        const std::uint32_t link = boxes.link(place);
        search.along.start(link);
        for (const std::uint32_t other_leaf : search.beside)
            for (unsigned bits = boxes.meeting(other_leaf, place); bits != 0; bits &= bits - 1) {
                const std::size_t other_place = other_leaf * kFan + static_cast<std::size_t>(std::countr_zero(bits));
                const std::uint32_t other = boxes.link(other_place);
                if (other_place <= place || search.along.reached(other)) continue;
                if (!may_touch(links[link], links[other], limit)) continue;
                const auto [low, high] = std::minmax(link, other);
                const double close = closest_approach(links[low], links[high]).closeness;
                if (close < limit) found.push_back({low, {high, static_cast<float>(close)}});
            }
    }
}

} // namespace

TouchingLinks::TouchingLinks(const Links& links, double limit, double together,
                             const LargeAllocator<std::byte>& memory) {
    constexpr std::size_t kLeavesAtOnce = 128;
    const LinkBoxes boxes(links, limit, memory);
    std::vector<std::vector<Found>> found((boxes.leaves() + kLeavesAtOnce - 1) / kLeavesAtOnce);
    tbb::enumerable_thread_specific<Search> searches([&] { return Search{AlongTree(links, together), {}}; });
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t n) {
        Search& search = searches.local();
        for (std::size_t leaf = n * kLeavesAtOnce; leaf < std::min((n + 1) * kLeavesAtOnce, boxes.leaves()); ++leaf)
            find_pairs(links, boxes, leaf, limit, search, found[n]);
    });
    others_ = Grouped<Other>(
        links.size(),
        [&](const auto& put) {
            for (const auto& some : found)
                for (const Found& pair : some) put(pair.low, pair.other);
        },
        memory);
    tbb::parallel_for(std::size_t{0}, links.size(),
                      [&](std::size_t n) { std::ranges::sort(others_.of(n), {}, &Other::link); });
}

std::uint32_t TouchingLinks::find(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto others = others_.of(low);
    const auto found = std::ranges::lower_bound(others, high, {}, &Other::link);
    return found != others.end() && found->link == high
               ? others_.first(low) + static_cast<std::uint32_t>(found - others.begin())
               : kNone;
}

} // namespace ramus::tree
