#include "render/scene/edge_owner.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace ramus::render {

namespace {

// How far a branch is behind the dominant one at a vertex, in steps of Dominance; as share() of border.geom.
int behind(std::int32_t branch, const field::Dominance& dominance, std::uint8_t mark) {
    if ((static_cast<std::uint32_t>(branch) & 255U) == mark) return 0;
    return std::max<int>(dominance.rivals[0] == mark ? dominance.over[0] : dominance.over[1], 1);
}

} // namespace

EdgeOwner owner_between(const EdgeOwner& a, const EdgeOwner& b) {
    const std::array<std::int32_t, 2> ends{a.branch, b.branch};
    std::array<std::uint8_t, 6> marks{};
    std::array<int, 6> sums{}; // twice how far behind
    std::size_t count = 0;
    const auto add = [&](std::uint8_t mark) {
        if (std::find(marks.begin(), marks.begin() + static_cast<std::ptrdiff_t>(count), mark) !=
            marks.begin() + static_cast<std::ptrdiff_t>(count))
            return;
        sums.at(count) = behind(a.branch, a.dominance, mark) + behind(b.branch, b.dominance, mark);
        marks.at(count++) = mark;
    };
    for (const std::int32_t branch : ends) add(static_cast<std::uint8_t>(static_cast<std::uint32_t>(branch) & 255U));
    for (const EdgeOwner* end : {&a, &b})
        for (const std::uint8_t rival : end->dominance.rivals) add(rival);
    const bool first_leads = ends[0] == ends[1] || count < 2 || sums[0] <= sums[1];
    const std::size_t leader = first_leads ? 0 : 1;
    EdgeOwner between{ends.at(leader), {{255, 255}, {0, 0}}};
    for (std::size_t place = 0; place < 2; ++place) { // the two that come next
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < count; ++i) {
            const bool taken = i == leader || (place == 1 && marks.at(i) == between.dominance.rivals[0]);
            if (!taken && (!next || sums.at(i) < sums.at(*next))) next = i;
        }
        if (!next) break;
        between.dominance.rivals.at(place) = marks.at(*next);
        between.dominance.over.at(place) =
            static_cast<std::uint8_t>(std::clamp((sums.at(*next) - sums.at(leader) + 1) / 2, 0, 255));
    }
    return between;
}

} // namespace ramus::render
