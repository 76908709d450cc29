#include "core/organ/certainty.h"

#include "core/organ/supply.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ramus::organ {

namespace {

// Means over nine organs of 30,000 leaves (ramus_bench_territories): by visible branches, then by territories.
constexpr std::array<double, 3> kVisible{60.0, 300.0, 1000.0}, kParts{2.0, 4.0, 8.0};
constexpr std::array<std::array<Certainty, 3>, 3> kMeasured{{{{{0.918, 2.9}, {0.845, 7.0}, {0.788, 11.9}}},
                                                             {{{0.943, 1.4}, {0.895, 2.4}, {0.862, 4.3}}},
                                                             {{{0.956, 0.5}, {0.919, 1.1}, {0.895, 1.8}}}}};

// Where a value lies among the measured ones: the index of the lower one, and the share of the next.
struct Place {
    std::size_t index = 0;
    double share = 0.0;
};

Place place_of(const std::array<double, 3>& measured, double value) {
    value = std::clamp(value, measured.front(), measured.back());
    const std::size_t index = value < measured[1] ? 0 : 1;
    return {index, std::log(value / measured[index]) / std::log(measured[index + 1] / measured[index])};
}

Certainty between(const Certainty& a, const Certainty& b, double share) {
    return {std::lerp(a.dice, b.dice, share), std::lerp(a.error_percent, b.error_percent, share)};
}

} // namespace

std::optional<Certainty> expected_certainty(std::size_t visible_branches, std::size_t territories) {
    const auto visible = static_cast<double>(visible_branches), parts = static_cast<double>(territories);
    if (visible < kVisible.front() || parts < kParts.front() || parts > kParts.back()) return std::nullopt;
    const Place row = place_of(kVisible, visible), column = place_of(kParts, parts);
    const auto at = [&](std::size_t n) {
        return between(kMeasured[n][column.index], kMeasured[n][column.index + 1], column.share);
    };
    return between(at(row.index), at(row.index + 1), row.share);
}

std::size_t visible_branches(const Organ& organ, const tree::VesselTree& tree, std::span<const std::uint8_t> systems) {
    const std::vector<std::uint8_t> inside = points_in(organ, tree);
    return static_cast<std::size_t>(std::ranges::count_if(tree.branches, [&](const tree::Branch& branch) {
        return systems[static_cast<std::size_t>(branch.system)] != 0 &&
               std::ranges::any_of(branch.points, [&](std::uint32_t point) { return inside[point] != 0; });
    }));
}

} // namespace ramus::organ
