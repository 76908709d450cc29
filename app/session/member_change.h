// MemberChange: the difference between two values of one member of Marks, in both directions, for undo. Memory: a list
// stores the replaced part, a set of branches a few bits per change, every other type both values.
#pragma once

#include "app/session/session.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

enum class ChangeDirection : std::uint8_t { kBack, kForward };

// apply() turns `before` into `after` or back; it must not be applied to other values.
class MemberChange {
public:
    MemberChange() = default;
    MemberChange(const MemberChange&) = delete;
    MemberChange& operator=(const MemberChange&) = delete;
    virtual ~MemberChange() = default;
    virtual void apply(Marks& marks, ChangeDirection direction) const = 0;
};

// Ascending branch ids, compressed as gaps or as bits, whichever is shorter.
class PackedIds {
public:
    PackedIds() = default;
    explicit PackedIds(std::span<const int> ascending);
    [[nodiscard]] std::vector<int> ids() const;
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    std::vector<std::uint8_t> bytes_;
    std::uint32_t count_ = 0;
    int first_ = 0; // id of the first bit
    bool bits_ = false;
};

// The branches that were selected or deselected.
class SelectionChange : public MemberChange {
public:
    SelectionChange(const std::vector<int>& before, const std::vector<int>& after);
    void apply(Marks& marks, ChangeDirection direction) const override;

private:
    PackedIds toggled_;
};

// The branches whose state differs, for each of the two bits of a state.
class StatesChange : public MemberChange {
public:
    using States = std::vector<tree::BranchState>;
    StatesChange(const States& before, const States& after);
    void apply(Marks& marks, ChangeDirection direction) const override;
    [[nodiscard]] std::vector<int> branches() const; // ascending

private:
    std::array<PackedIds, 2> toggled_; // by bit
};

// A contiguous part of a list was replaced.
template <class T> class ListChange : public MemberChange {
public:
    using List = std::vector<T>;
    ListChange(List Marks::*list, const List& before, const List& after) : list_(list) {
        const auto [b, a] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
        auto before_end = before.end(), after_end = after.end();
        while (before_end != b && after_end != a && *std::prev(before_end) == *std::prev(after_end))
            --before_end, --after_end;
        at_ = b - before.begin();
        removed_.assign(b, before_end);
        inserted_.assign(a, after_end);
    }
    void apply(Marks& marks, ChangeDirection direction) const override {
        const bool forward = direction == ChangeDirection::kForward;
        const List& out = forward ? removed_ : inserted_;
        const List& in = forward ? inserted_ : removed_;
        List& list = marks.*list_;
        const auto place = list.begin() + at_;
        const auto rest = list.erase(place, place + static_cast<std::ptrdiff_t>(out.size()));
        list.insert(rest, in.begin(), in.end());
    }

private:
    List Marks::*list_;
    std::ptrdiff_t at_ = 0;
    List removed_, inserted_;
};

// The entries of a map that were added, removed or changed.
template <class Key, class T> class MapChange : public MemberChange {
public:
    using Map = std::map<Key, T>;
    MapChange(Map Marks::*map, const Map& before, const Map& after) : map_(map) {
        for (const auto& [key, value] : before) {
            const auto now = after.find(key);
            if (now == after.end())
                entries_.push_back({key, value, {}});
            else if (!(now->second == value))
                entries_.push_back({key, value, now->second});
        }
        for (const auto& [key, value] : after)
            if (!before.contains(key)) entries_.push_back({key, {}, value});
    }
    void apply(Marks& marks, ChangeDirection direction) const override {
        for (const Entry& entry : entries_) {
            const auto& value = direction == ChangeDirection::kForward ? entry.after : entry.before;
            if (value)
                (marks.*map_)[entry.key] = *value;
            else
                (marks.*map_).erase(entry.key);
        }
    }

private:
    struct Entry {
        Key key;
        std::optional<T> before, after;
    };
    Map Marks::*map_;
    std::vector<Entry> entries_;
};

template <class T> class ValueChange : public MemberChange {
public:
    ValueChange(T Marks::*member, T before, T after)
        : member_(member), before_(std::move(before)), after_(std::move(after)) {}
    void apply(Marks& marks, ChangeDirection direction) const override {
        marks.*member_ = direction == ChangeDirection::kForward ? after_ : before_;
    }

private:
    T Marks::*member_;
    T before_, after_;
};

// The change of one member; the overload selects the form that suits its type.
template <class T>
std::shared_ptr<const MemberChange> member_change(T Marks::*member, const T& before, const T& after) {
    return std::make_shared<ValueChange<T>>(member, before, after);
}
template <class T>
std::shared_ptr<const MemberChange> member_change(std::vector<T> Marks::*member, const std::vector<T>& before,
                                                  const std::vector<T>& after) {
    return std::make_shared<ListChange<T>>(member, before, after);
}
template <class Key, class T>
std::shared_ptr<const MemberChange> member_change(std::map<Key, T> Marks::*member, const std::map<Key, T>& before,
                                                  const std::map<Key, T>& after) {
    return std::make_shared<MapChange<Key, T>>(member, before, after);
}

} // namespace ramus::app
