#include "app/session/marks_change.h"

#include <algorithm>
#include <iterator>

namespace ramus::app {

using render::BranchState;
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
        for (std::size_t i = 0; i < 8 * bytes_.size(); ++i)
            if ((bytes_[i / 8] >> (i % 8) & 1U) != 0) found.push_back(first_ + static_cast<int>(i));
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

template <class T>
std::optional<Splice<T>> Splice<T>::between(const std::vector<T>& before, const std::vector<T>& after) {
    if (before == after) return {};
    const auto [b, a] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
    auto before_end = before.end();
    auto after_end = after.end();
    while (before_end != b && after_end != a && *std::prev(before_end) == *std::prev(after_end))
        --before_end, --after_end;
    return Splice{static_cast<std::size_t>(b - before.begin()), {b, before_end}, {a, after_end}};
}

template <class T> void Splice<T>::apply(std::vector<T>& list, ChangeDirection direction) const {
    const std::vector<T>& out = direction == ChangeDirection::kForward ? removed : inserted;
    const std::vector<T>& in = direction == ChangeDirection::kForward ? inserted : removed;
    const auto place = list.begin() + static_cast<std::ptrdiff_t>(at);
    const auto rest = list.erase(place, place + static_cast<std::ptrdiff_t>(out.size()));
    list.insert(rest, in.begin(), in.end());
}

namespace {

std::vector<int> in_one_only(const std::vector<int>& a, const std::vector<int>& b) {
    std::vector<int> found;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(found));
    return found;
}

unsigned state_bits(const Marks& marks, std::size_t branch) {
    return branch < marks.states.size() ? static_cast<unsigned>(marks.states[branch]) : 0U;
}

// In the order of MarksChange::Seldom::lists, and what else is told apart from its `others`.
constexpr std::tuple kLists{&Marks::lesions, &Marks::lesion_meshes, &Marks::edits, &Marks::cuts, &Marks::measurements};
constexpr auto kApart = std::tuple_cat(kLists, std::tuple{&Marks::selection, &Marks::states, &Marks::names});

void for_lists(auto& splices, const auto& call) {
    const auto with = [&](auto... list) { std::apply([&](auto&... splice) { (call(splice, list), ...); }, splices); };
    std::apply(with, kLists);
}

void for_apart(const auto& call) {
    std::apply([&](auto... member) { (call(member), ...); }, kApart);
}

Marks without_lists(Marks marks) {
    for_apart([&](auto member) { (marks.*member).clear(); });
    return marks;
}

} // namespace

MarksChange MarksChange::between(const Marks& before, const Marks& after) {
    MarksChange change;
    change.selection_ = PackedIds(in_one_only(before.selection, after.selection));
    std::array<std::vector<int>, 2> differing;
    for (std::size_t i = 0; i < std::max(before.states.size(), after.states.size()); ++i) {
        const unsigned bits = state_bits(before, i) ^ state_bits(after, i);
        for (unsigned bit = 0; bit < 2; ++bit)
            if ((bits >> bit & 1U) != 0) differing[bit].push_back(static_cast<int>(i));
    }
    for (std::size_t bit = 0; bit < 2; ++bit) change.states_[bit] = PackedIds(differing[bit]);

    Seldom seldom;
    bool any_list = false;
    for_lists(seldom.lists, [&]<class T>(std::optional<Splice<T>>& splice, auto list) {
        splice = Splice<T>::between(before.*list, after.*list);
        any_list |= splice.has_value();
    });
    if (before.names != after.names) {
        for (const auto& [branch, name] : before.names) {
            const auto now = after.names.find(branch);
            if (now == after.names.end())
                seldom.names.push_back({branch, name, {}});
            else if (now->second != name)
                seldom.names.push_back({branch, name, now->second});
        }
        for (const auto& [branch, name] : after.names)
            if (!before.names.contains(branch)) seldom.names.push_back({branch, {}, name});
    }
    if (auto a = without_lists(before), b = without_lists(after); a != b)
        seldom.others = std::pair(std::move(a), std::move(b));
    if (any_list || !seldom.names.empty() || seldom.others)
        change.seldom_ = std::make_shared<const Seldom>(std::move(seldom));
    return change;
}

void MarksChange::apply(Marks& marks, Direction direction) const {
    if (seldom_ && seldom_->others) {
        Marks next = direction == Direction::kForward ? seldom_->others->second : seldom_->others->first;
        for_apart([&](auto member) { next.*member = std::move(marks.*member); });
        marks = std::move(next);
    }
    if (!selection_.empty()) marks.selection = in_one_only(marks.selection, selection_.ids());
    for (unsigned bit = 0; bit < 2; ++bit)
        for (const int branch : states_[bit].ids()) {
            const auto index = static_cast<std::size_t>(branch);
            if (index >= marks.states.size()) marks.states.resize(index + 1, BranchState::kNormal);
            marks.states[index] = static_cast<BranchState>(static_cast<unsigned>(marks.states[index]) ^ (1U << bit));
        }
    set_state(marks, {}, BranchState::kNormal); // trailing normal ones go
    if (!seldom_) return;
    for_lists(seldom_->lists, [&](const auto& splice, auto list) {
        if (splice) splice->apply(marks.*list, direction);
    });
    for (const Renaming& renaming : seldom_->names) {
        const auto& name = direction == Direction::kForward ? renaming.after : renaming.before;
        if (name)
            marks.names[renaming.branch] = *name;
        else
            marks.names.erase(renaming.branch);
    }
}

std::vector<int> MarksChange::restated() const {
    const std::vector<int> low = states_[0].ids();
    const std::vector<int> high = states_[1].ids();
    std::vector<int> both;
    std::set_union(low.begin(), low.end(), high.begin(), high.end(), std::back_inserter(both));
    return both;
}

} // namespace ramus::app
