// The filter language of the list of branches. A branch passes if all conditions and words hold.
//
//     d>3            mean diameter in mm; also gen, strahler, len, deps, vol, dist (mm from the root), id
//     gen<=5 len>=20 operators < <= > >= = !=; blanks around them and units are allowed ("d > 3 mm")
//     system:portal  occurs in the name of the branch's system; system:"hepatic vein" with blanks
//     is:hidden      also selected, highlighted, defocused, normal, leaf, named
//     right hepatic  words occur in the label or in the system's name, ignoring case; "quoted words" as a phrase
//     17             a whole number is an id, or occurs in the label
//
// Parsing is a pure function: it returns a filter or an error for any text.
#pragma once

#include "app/session/labels.h"
#include "app/session/quantity.h"
#include "app/session/session.h"
#include "core/base/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

enum class Relation { kLess, kLessOrEqual, kGreater, kGreaterOrEqual, kEqual, kNotEqual };
// States in the order of tree::BranchState, then other properties.
enum class BranchProperty { kNormal, kHighlighted, kDefocused, kHidden, kSelected, kLeaf, kNamed };

struct BranchCondition {
    enum class Kind { kQuantity, kProperty, kText, kSystem };
    Kind kind = Kind::kText;
    Quantity quantity = Quantity::kId;
    Relation comparison = Relation::kEqual;
    double value = 0.0;
    BranchProperty property = BranchProperty::kNormal;
    std::string text{}; // lower case
    bool operator==(const BranchCondition&) const = default;
};

using BranchFilter = std::vector<BranchCondition>; // empty: every branch passes

[[nodiscard]] Result<BranchFilter> parse_branch_filter(std::string_view text);

// The branches that pass, ascending. Linear.
[[nodiscard]] std::vector<int> branches_passing(const BranchFilter& filter, const tree::VesselTree& tree,
                                                const TreeFacts& facts, const Marks& marks);

} // namespace ramus::app
