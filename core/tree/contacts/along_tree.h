// AlongTree: a breadth-first search along the tree from one link, through points that stay close to that link. Reuses
// its memory from search to search.
#pragma once

#include "core/tree/contacts/links.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::tree {

class AlongTree {
public:
    // The search passes a point of the tree only if its closeness to the start link is below `limit`. The two ends of
    // the start link are always passed.
    AlongTree(const Links& links, double limit) : links_(links), limit_(limit), reached_from_(links.size(), kNoLink) {}

    // Runs the search from `link`. The other functions return its result.
    void start(std::uint32_t link) {
        start_ = link;
        all_.clear();
        add(link, links_[link].from);
        go_on_through(links_[link].from);
        go_on_through(links_[link].to);
        for (std::size_t n = 1; n < all_.size(); ++n) {
            const auto [at, came_through] = all_[n];
            const Link here = links_[at];
            const bool to_end = here.from == came_through;
            if (closer(to_end ? here.b : here.a, links_[link], limit_)) go_on_through(to_end ? here.to : here.from);
        }
    }

    [[nodiscard]] bool reached(std::uint32_t link) const { return reached_from_[link] == start_; }
    struct Arrival {
        std::uint32_t link, through; // the link, and the point of the tree through which it was reached
    };
    // The start link, then all links reached, in breadth-first order.
    [[nodiscard]] const std::vector<Arrival>& all() const { return all_; }

private:
    static constexpr std::uint32_t kNoLink = 0xFFFFFFFFU;

    void add(std::uint32_t link, std::uint32_t through) {
        reached_from_[link] = start_;
        all_.push_back({link, through});
    }
    void go_on_through(std::uint32_t point) {
        for (const std::uint32_t next : links_.at(point))
            if (reached_from_[next] != start_) add(next, point);
    }

    const Links& links_;
    double limit_;
    std::uint32_t start_ = kNoLink;
    std::vector<std::uint32_t> reached_from_; // by link: the start of the last search that reached it
    std::vector<Arrival> all_;
};

} // namespace ramus::tree
