#include "core/tree/edit_tree.h"

#include "core/base/words.h"
#include "core/tree/build_tree.h"
#include "core/tree/edit_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ramus::tree {

namespace {

std::string branches_in_words(const std::vector<int>& ids) {
    constexpr std::size_t kListed = 5;
    if (ids.size() == 1) return "branch " + std::to_string(ids.front());
    return std::to_string(ids.size()) + " branches (" +
           joined(std::span(ids).first(std::min(ids.size(), kListed)), ", ",
                  [](int id) { return std::to_string(id); }) +
           (ids.size() > kListed ? ", ...)" : ")");
}

Result<void> check(const VesselTree& tree, const Edit& edit) {
    const bool two = edit.kind == Edit::Kind::kJoin;
    const bool many =
        edit.kind == Edit::Kind::kDelete || edit.kind == Edit::Kind::kRadius || edit.kind == Edit::Kind::kScale;
    if (edit.branches.empty() || (!many && edit.branches.size() != (two ? 2U : 1U)))
        return fail("the edit \"" + std::string(name_of(edit.kind)) + "\" names " +
                        std::to_string(edit.branches.size()) + " branches",
                    {},
                    many  ? "name one at least"
                    : two ? "name two"
                          : "name one");
    for (const int id : edit.branches)
        if (id < 0 || static_cast<std::size_t>(id) >= tree.branches.size())
            return fail("there is no branch " + std::to_string(id) + " in a tree of " +
                            std::to_string(tree.branches.size()),
                        {}, "the edit belongs to another tree");
    for (const double fraction : edit.fractions)
        if (!(fraction >= 0.0 && fraction <= 1.0))
            return fail("a place on a branch is not between 0 and 1", {}, "give a fraction of the branch's length");
    if (!std::isfinite(edit.value) || edit.value < 0.0)
        return fail("the number of an edit is not finite, or below 0", {}, "give a positive number");
    return {};
}

} // namespace

std::string_view name_of(Edit::Kind kind) { return paired(kEditNames, kind).value_or(""); }

std::string sentence(const Edit& edit) {
    const std::string who = branches_in_words(edit.branches);
    const std::string were = edit.branches.size() == 1 ? " was " : " were ";
    switch (edit.kind) {
    case Edit::Kind::kJoin:
        return "branch " + std::to_string(edit.branches[0]) +
               (edit.fractions[0] > 0.5 ? ", its end," : ", its beginning,") + " was joined with branch " +
               std::to_string(edit.branches[1]) + " at " + in_digits(edit.fractions[1]);
    case Edit::Kind::kCut:
        return who + were + "cut at " + in_digits(edit.fractions[0]);
    case Edit::Kind::kDelete:
        return who + were + "deleted";
    case Edit::Kind::kMoveRoot:
        return "the root was moved to an end of " + who;
    case Edit::Kind::kFlip:
        return who + were + "turned round, and the root with it";
    case Edit::Kind::kRadius:
        return who + were + "given the radius " + in_digits(edit.value) + " mm";
    case Edit::Kind::kScale:
        return "the radii of " + who + " were multiplied by " + in_digits(edit.value);
    }
    return {};
}

Result<EditedTree> apply(const VesselTree& tree, const Edit& edit) {
    if (auto good = check(tree, edit); !good) return tl::unexpected(good.error());
    constexpr std::array kSteps{join, cut, remove_branches, move_root, flip, change_radii, change_radii}; // as `Kind`
    return kSteps[static_cast<std::size_t>(edit.kind)](tree, edit);
}

Result<VesselTree> apply_all(VesselTree tree, std::span<const Edit> edits) {
    for (const Edit& edit : edits) {
        RAMUS_TRY(edited, apply(tree, edit));
        tree = std::move(edited.tree);
    }
    return tree;
}

std::vector<int> degrees(const VesselTree& tree) {
    std::vector<int> count(tree.points.size(), 0);
    for (const Branch& branch : tree.branches) {
        for (const std::uint32_t p : branch.points) count[p] += 2;
        --count[branch.points.front()], --count[branch.points.back()];
    }
    return count;
}

} // namespace ramus::tree
