#include "app/session/member_change.h"

#include <bit>

namespace ramus::app {

using tree::BranchState;
static_assert(static_cast<int>(BranchState::kNormal) < 4 && static_cast<int>(BranchState::kHighlighted) < 4 &&
                  static_cast<int>(BranchState::kDefocused) < 4 && static_cast<int>(BranchState::kHidden) < 4,
              "a state fits into two bits");

PackedIds::PackedIds(std::span<const int> ascending) : count_(static_cast<std::uint32_t>(ascending.size())) {
    if (ascending.empty()) return;
    const auto span = static_cast<std::size_t>(ascending.back() - ascending.front()) + 1;
    const std::size_t as_bits = (span + 7) / 8;
    // Seven bits of a gap in each byte; the highest says that more follow.
    std::vector<std::uint8_t> gaps;
    int next = 0;
    for (const int id : ascending) {
        auto gap = static_cast<std::uint32_t>(id - next);
        for (; gap >= 128; gap >>= 7) gaps.push_back(static_cast<std::uint8_t>(gap | 128));
        gaps.push_back(static_cast<std::uint8_t>(gap));
        next = id + 1;
        if (gaps.size() > as_bits) break;
    }
    if (gaps.size() <= as_bits) {
        bytes_.assign(gaps.begin(), gaps.end());
        return;
    }
    bits_ = true;
    first_ = ascending.front();
    bytes_.assign(as_bits, 0);
    for (const int id : ascending) {
        const auto at = static_cast<std::size_t>(id - first_);
        bytes_[at / 8] = static_cast<std::uint8_t>(bytes_[at / 8] | (1U << (at % 8)));
    }
}

std::vector<int> PackedIds::ids() const {
    std::vector<int> found;
    found.reserve(count_);
    if (bits_) {
        for (std::size_t i = 0; i < bytes_.size(); ++i)
            for (unsigned left = bytes_[i]; left != 0; left &= left - 1)
                found.push_back(first_ + static_cast<int>(8 * i) + std::countr_zero(left));
        return found;
    }
    int next = 0;
    for (std::size_t i = 0; i < bytes_.size();) {
        std::uint32_t gap = 0;
        for (int shift = 0;; shift += 7) {
            const std::uint8_t byte = bytes_[i++];
            gap |= static_cast<std::uint32_t>(byte & 127) << shift;
            if (byte < 128) break;
        }
        found.push_back(next + static_cast<int>(gap));
        next = found.back() + 1;
    }
    return found;
}

namespace {

std::vector<int> in_one_only(const std::vector<int>& a, const std::vector<int>& b) {
    std::vector<int> found;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(found));
    return found;
}

unsigned bits_of(const std::vector<BranchState>& states, std::size_t branch) {
    return branch < states.size() ? static_cast<unsigned>(states[branch]) : 0U;
}

} // namespace

SelectionChange::SelectionChange(const std::vector<int>& before, const std::vector<int>& after)
    : toggled_(in_one_only(before, after)) {}

void SelectionChange::apply(Marks& marks, ChangeDirection /*direction*/) const {
    marks.selection = in_one_only(marks.selection, toggled_.ids());
}

StatesChange::StatesChange(const States& before, const States& after) {
    std::array<std::vector<int>, 2> differing;
    for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i) {
        const unsigned bits = bits_of(before, i) ^ bits_of(after, i);
        for (unsigned bit = 0; bit < 2; ++bit)
            if ((bits >> bit & 1U) != 0) differing[bit].push_back(static_cast<int>(i));
    }
    for (std::size_t bit = 0; bit < 2; ++bit) toggled_[bit] = PackedIds(differing[bit]);
}

void StatesChange::apply(Marks& marks, ChangeDirection /*direction*/) const {
    for (unsigned bit = 0; bit < 2; ++bit)
        for (const int branch : toggled_[bit].ids()) {
            const auto index = static_cast<std::size_t>(branch);
            if (index >= marks.states.size()) marks.states.resize(index + 1, BranchState::kNormal);
            marks.states[index] = static_cast<BranchState>(static_cast<unsigned>(marks.states[index]) ^ (1U << bit));
        }
    set_state(marks, {}, BranchState::kNormal); // drops trailing normal states
}

std::vector<int> StatesChange::branches() const {
    const std::vector<int> low = toggled_[0].ids(), high = toggled_[1].ids();
    std::vector<int> both;
    std::set_union(low.begin(), low.end(), high.begin(), high.end(), std::back_inserter(both));
    return both;
}

} // namespace ramus::app
