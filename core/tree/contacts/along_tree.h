// What can be reached along the tree from one link after the other, by a walker who stays close to it.
#pragma once

#include "core/tree/contacts/links.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::tree {

class AlongTree {
public:
    // At the points through which the walker goes, the closeness to the link that it starts from is below `limit`.
    AlongTree(const Links& links, double limit)
        : links_(links), limit_(limit), reached_from_(links.all().size(), kNoLink) {}

    // From now on the others tell of this link.
    void start(std::uint32_t link) {
        start_ = link;
        all_.clear();
        add(link, links_[link].from);
        go_on_through(links_[link].from);
        go_on_through(links_[link].to);
        for (std::size_t n = 1; n < all_.size(); ++n) {
            const auto [at, came_through] = all_[n];
            const Link& here = links_[at];
            const bool to_end = here.from == came_through;
            if (closer(to_end ? here.b : here.a, links_[link], limit_)) go_on_through(to_end ? here.to : here.from);
        }
    }

    [[nodiscard]] bool reached(std::uint32_t link) const { return reached_from_[link] == start_; }
    struct Arrival {
        std::uint32_t link, through; // a point of the tree
    };
    // The link itself, then the others, those first that take fewer links to reach.
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
    std::vector<std::uint32_t> reached_from_; // by link, the last that it was reached from
    std::vector<Arrival> all_;
};

} // namespace ramus::tree
