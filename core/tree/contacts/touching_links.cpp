#include "core/tree/contacts/touching_links.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::tree {

namespace {

struct Box {
    glm::dvec3 least{0.0}, most{0.0};

    void add(const Box& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }
    [[nodiscard]] bool meets(const Box& other) const {
        return glm::all(glm::lessThanEqual(least, other.most)) && glm::all(glm::lessThanEqual(other.least, most));
    }
};

// 10 bits of a number with two bits between each.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16U) & 0x030000FFU;
    x = (x | x << 8U) & 0x0300F00FU;
    x = (x | x << 4U) & 0x030C30C3U;
    return (x | x << 2U) & 0x09249249U;
}

// Boxes around links as far as they may touch others, eight to a box of the next level, in Morton order.
class BoxTree {
public:
    BoxTree(const Links& links, double limit) : boxes_(links.all().size()), order_(links.all().size()) {
        Box all{glm::dvec3(1e300), glm::dvec3(-1e300)};
        for (std::size_t n = 0; n < boxes_.size(); ++n) {
            const Link& link = links[n];
            const glm::dvec3 ra(limit * link.a.radius);
            const glm::dvec3 rb(limit * link.b.radius);
            boxes_[n] = {glm::min(link.a.position - ra, link.b.position - rb),
                         glm::max(link.a.position + ra, link.b.position + rb)};
            all.add(boxes_[n]);
        }
        std::vector<std::uint32_t> place(boxes_.size());
        const glm::dvec3 scale = 1023.0 / glm::max(all.most - all.least, glm::dvec3(1e-300));
        for (std::size_t n = 0; n < boxes_.size(); ++n) {
            const glm::uvec3 cell((0.5 * (boxes_[n].least + boxes_[n].most) - all.least) * scale);
            place[n] = spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
        }
        std::iota(order_.begin(), order_.end(), 0U);
        tbb::parallel_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(place[a], a) < std::pair(place[b], b);
        });
        std::vector<Box> leaves(boxes_.size());
        for (std::size_t n = 0; n < boxes_.size(); ++n) leaves[n] = boxes_[order_[n]];
        levels_.push_back(std::move(leaves));
        while (levels_.back().size() > 1) {
            const std::vector<Box>& below = levels_.back();
            std::vector<Box> level;
            for (std::size_t n = 0; n < below.size(); n += kFan) {
                level.push_back(below[n]);
                for (std::size_t m = n + 1; m < std::min(n + kFan, below.size()); ++m) level.back().add(below[m]);
            }
            levels_.push_back(std::move(level));
        }
    }

    template <class Call> void for_each_meeting(std::uint32_t link, const Call& call) const {
        if (!levels_.front().empty()) descend(levels_.size() - 1, 0, boxes_[link], call);
    }

private:
    static constexpr std::size_t kFan = 8;

    template <class Call> void descend(std::size_t level, std::size_t n, const Box& box, const Call& call) const {
        if (!levels_[level][n].meets(box)) return;
        if (level == 0) {
            call(order_[n]);
            return;
        }
        const std::size_t end = std::min((n + 1) * kFan, levels_[level - 1].size());
        for (std::size_t m = n * kFan; m < end; ++m) descend(level - 1, m, box, call);
    }

    std::vector<Box> boxes_;           // by link
    std::vector<std::uint32_t> order_; // links in Morton order
    std::vector<std::vector<Box>> levels_;
};

} // namespace

TouchingLinks::TouchingLinks(const Links& links, double limit) : first_(links.all().size() + 1, 0) {
    const BoxTree boxes(links, limit);
    std::vector<std::vector<Other>> rows(links.all().size());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t a) {
        const auto link = static_cast<std::uint32_t>(a);
        boxes.for_each_meeting(link, [&](std::uint32_t b) {
            if (b <= link) return;
            const double close = links.joined(a, b) ? 0.0 : closest_approach(links[a], links[b]).closeness;
            if (close < limit) rows[a].push_back({b, static_cast<float>(close)});
        });
        std::ranges::sort(rows[a], {}, &Other::link);
    });
    for (std::size_t a = 0; a < rows.size(); ++a)
        first_[a + 1] = first_[a] + static_cast<std::uint32_t>(rows[a].size());
    others_.reserve(first_.back());
    for (const auto& row : rows) others_.insert(others_.end(), row.begin(), row.end());
}

std::uint32_t TouchingLinks::find(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto begin = others_.begin() + first_[low];
    const auto end = others_.begin() + first_[low + 1];
    const auto found = std::ranges::lower_bound(begin, end, high, {}, &Other::link);
    return found != end && found->link == high ? static_cast<std::uint32_t>(found - others_.begin()) : kNone;
}

} // namespace ramus::tree
