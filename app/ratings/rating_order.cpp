#include "app/ratings/rating_order.h"

#include "app/session/checksum.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace ramus::app {

namespace {

// std::shuffle differs from library to library; the numbers of this generator do not.
template <class List> void shuffle(List& list, const std::string& seed) {
    std::mt19937_64 random(Checksum().add(seed).number());
    for (std::size_t left = list.size(); left > 1; --left) std::swap(list[left - 1], list[random() % left]);
}

// All permutations of this many things.
std::vector<std::vector<std::size_t>> permutations(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::vector<std::size_t>> all;
    do all.push_back(order);
    while (std::ranges::next_permutation(order).found);
    return all;
}

} // namespace

std::vector<RaterOrder> rater_orders(const RatingStudy& study, int raters) {
    const std::string seed = std::to_string(study.seed);
    std::vector<RaterOrder> orders(static_cast<std::size_t>(raters));
    for (std::size_t view = 0; view < study.views.size(); ++view) {
        const auto all = permutations(study.views[view].pictures.size());
        auto block = all;
        for (std::size_t rater = 0; rater < orders.size(); ++rater) {
            if (rater % all.size() == 0) {
                block = all;
                shuffle(block,
                        seed + " scene " + std::to_string(view) + " block " + std::to_string(rater / all.size()));
            }
            orders[rater].push_back({view, block[rater % all.size()]});
        }
    }
    for (std::size_t rater = 0; rater < orders.size(); ++rater)
        shuffle(orders[rater], seed + " rater " + std::to_string(rater));
    return orders;
}

} // namespace ramus::app
