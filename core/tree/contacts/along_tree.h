// AlongTree: a breadth-first search along the tree from one link, through points that stay close to that link. Reuses
// its memory from search to search.
#pragma once

#include "core/tree/contacts/links.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::tree {

class AlongTree {
public:
    // The search passes a point of the tree only if its closeness to the start link is below `limit`. The two ends of
    // the start link are always passed.
    AlongTree(const Links& links, double limit) : links_(links), limit_(limit), reached_in_(links.size(), 0) {}

    // Runs the search from `link`. The other functions return its result.
    void start(std::uint32_t link) {
        if (++search_ == 0) std::ranges::fill(reached_in_, 0U), search_ = 1;
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

    [[nodiscard]] bool reached(std::uint32_t link) const { return reached_in_[link] == search_; }
    struct Arrival {
        std::uint32_t link, through; // the link, and the point of the tree through which it was reached
    };
    // The start link, then all links reached, in breadth-first order.
    [[nodiscard]] const std::vector<Arrival>& all() const { return all_; }

private:
    void add(std::uint32_t link, std::uint32_t through) {
        reached_in_[link] = search_;
        all_.push_back({link, through});
    }
    void go_on_through(std::uint32_t point) {
        for (const std::uint32_t next : links_.at(point))
            if (reached_in_[next] != search_) add(next, point);
    }

    const Links& links_;
    double limit_;
    std::uint32_t search_ = 0;              // its number; several may begin at one link
    std::vector<std::uint32_t> reached_in_; // by link: the last search that reached it
    std::vector<Arrival> all_;
};

} // namespace ramus::tree
