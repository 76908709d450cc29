// MarksChange: what lies between two values of Marks, both ways, in little memory: a history of thousands of steps on a
// tree of tens of thousands of branches stays small, for a step costs what it changed and at most a few bits a branch.
//
// between(a, b) applied forward to a gives b, backward to b gives a, exactly; to other values it must not be applied.
// Members of Marks that it does not know are kept whole, so that none is ever forgotten.
#pragma once

#include "app/session/session.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace ramus::app {

// Ascending branch ids, as gaps or as bits, whichever is shorter.
class PackedIds {
public:
    PackedIds() = default;
    explicit PackedIds(std::span<const int> ascending);
    [[nodiscard]] std::vector<int> ids() const;
    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    std::vector<std::uint8_t> bytes_;
    std::uint32_t count_ = 0;
    int first_ = 0; // of the bits
    bool bits_ = false;
};

enum class ChangeDirection { kBack, kForward };

// A part of a list that was replaced by another; all before and behind it stayed. (Outside of the class below: clang 14
// forgets members of a template that stands in there.)
template <class T> struct Splice {
    std::size_t at = 0;
    std::vector<T> removed, inserted;
    [[nodiscard]] static std::optional<Splice> between(const std::vector<T>& before, const std::vector<T>& after);
    void apply(std::vector<T>& list, ChangeDirection direction) const;
};
template <class... T> using Splices = std::tuple<std::optional<Splice<T>>...>; // none: the lists are the same

class MarksChange {
public:
    using Direction = ChangeDirection;

    [[nodiscard]] static MarksChange between(const Marks& before, const Marks& after);
    void apply(Marks& marks, Direction direction) const;

    // Branches have other ids then.
    [[nodiscard]] bool edits_tree() const {
        const bool read_again =
            seldom_ && seldom_->others && seldom_->others->first.reading != seldom_->others->second.reading;
        return read_again || (seldom_ && std::get<std::optional<Splice<tree::Edit>>>(seldom_->lists));
    }
    [[nodiscard]] bool selects() const { return !selection_.empty(); }
    // Branches whose state differs, ascending.
    [[nodiscard]] std::vector<int> restated() const;

private:
    struct Renaming {
        int branch = 0;
        std::optional<std::string> before, after;
    };
    // What is small, or changes seldom.
    struct Seldom {
        Splices<std::array<double, 4>, std::string, tree::Edit, std::pair<int, double>, Measurement> lists;
        std::vector<Renaming> names;
        std::optional<std::pair<Marks, Marks>> others; // with the members above, selection and states empty
    };

    PackedIds selection_;                  // who entered or left it
    std::array<PackedIds, 2> states_;      // whose state differs in this bit
    std::shared_ptr<const Seldom> seldom_; // null: nothing of it differs
};

} // namespace ramus::app
