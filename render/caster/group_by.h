// Items grouped by a number, in their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::render::caster {

// Those of group g are items[first[g]] to items[first[g + 1] - 1]. for_each(call) calls call(item, group) for all of
// them, twice the same.
template <class ForEach>
void group_by(std::size_t groups, const ForEach& for_each, std::vector<std::uint32_t>& first,
              std::vector<std::uint32_t>& items) {
    first.assign(groups + 2, 0); // a group ahead, so that filling moves them to where they begin
    for_each([&](std::uint32_t, std::size_t group) { ++first[group + 2]; });
    for (std::size_t group = 0; group < groups; ++group) first[group + 2] += first[group + 1];
    items.resize(first.back());
    for_each([&](std::uint32_t item, std::size_t group) { items[first[group + 1]++] = item; });
}

} // namespace ramus::render::caster
