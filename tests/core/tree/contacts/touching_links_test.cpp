// Pairs of links that touch, against all pairs tried one by one.
#include "core/tree/contacts/along_tree.h"
#include "core/tree/contacts/touching_links.h"
#include "tests/support/packed_trees.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <vector>

namespace ramus::tree {

namespace {

constexpr double kLimit = 1.4, kTogether = 1.1;

PreparedTree prepared_of(const VesselTree& tree) {
    PreparedTree prepared;
    prepared.tree = tree;
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
        prepared.segment_source.insert(prepared.segment_source.end(), tree.branches[b].points.size() - 1,
                                       static_cast<int>(b));
    return prepared;
}

// The links to which one can walk along the tree and stay close to one of them.
std::vector<bool> along_tree(const Links& links, std::uint32_t from) {
    std::vector<bool> reached(links.size(), false);
    std::vector<std::uint32_t> open{from};
    reached[from] = true;
    while (!open.empty()) {
        const Link at = links[open.back()];
        const bool starts = open.back() == from;
        open.pop_back();
        for (const bool end : {false, true}) {
            if (!starts && closeness(end ? at.b : at.a, links[from]) >= kTogether) continue;
            for (const std::uint32_t next : links.at(end ? at.to : at.from))
                if (!reached[next]) reached[next] = true, open.push_back(next);
        }
    }
    return reached;
}

} // namespace

TEST_CASE("a search along the tree finds the same, also when another one began at the same link before") {
    const PreparedTree prepared = prepared_of(test::packed_trees(1));
    const Links links(prepared);
    AlongTree along(links, kTogether);
    const auto count = static_cast<std::uint32_t>(links.size());
    for (std::uint32_t n = 0; n < 3 * count; ++n) {
        const std::uint32_t from = n % 2 == 0 ? n % count : (n + 1) / 2 % 7;
        along.start(from);
        const std::vector<bool> expected = along_tree(links, from);
        for (std::uint32_t link = 0; link < count; ++link) REQUIRE(along.reached(link) == expected[link]);
        REQUIRE(along.all().size() == static_cast<std::size_t>(std::ranges::count(expected, true)));
    }
}

TEST_CASE("all pairs of links that touch are found, but for neighbours along the tree") {
    for (const std::uint64_t seed : {1U, 2U}) {
        CAPTURE(seed);
        const PreparedTree prepared = prepared_of(test::packed_trees(seed));
        const Links links(prepared);
        const auto count = static_cast<std::uint32_t>(links.size());
        const TouchingLinks touching(links, kLimit, kTogether);
        std::vector<std::vector<bool>> along;
        for (std::uint32_t a = 0; a < count; ++a) along.push_back(along_tree(links, a));
        std::size_t found = 0, left_out = 0, missed = 0, wrong = 0;
        for (std::uint32_t a = 0; a < count; ++a)
            for (std::uint32_t b = a + 1; b < count; ++b) {
                const double close = closest_approach(links[a], links[b]).closeness;
                const std::uint32_t pair = touching.find(b, a);
                if (pair != TouchingLinks::kNone) {
                    ++found;
                    wrong += touching.other(pair).closeness == static_cast<float>(close) && close < kLimit ? 0 : 1;
                } else if (along[a][b] || along[b][a]) {
                    ++left_out;
                } else if (close < kLimit) {
                    ++missed;
                }
            }
        CHECK(found == touching.size());
        CHECK(wrong == 0);
        CHECK(missed == 0);
        CHECK(found > 1000);
        CHECK(left_out > found); // nearly all are neighbours
    }
}

} // namespace ramus::tree
