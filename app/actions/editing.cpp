// Commands that repair a tree: join, cut, delete, move the root, change radii.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/numbers.h"
#include "app/session/tree_edits.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::app::actions {

namespace {

using tree::Edit;
using Kind = tree::Edit::Kind;

std::string branch_word(int id) { return "branch " + std::to_string(id); }

// A fraction, or one of the two ends.
std::optional<double> place_in(const std::string& word) {
    if (word == "start") return 0.0;
    if (word == "end") return 1.0;
    return number_in(word, 0.0, 1.0);
}

// The branch in the first argument, or the only selected one.
Result<int> one_branch(const Document& document, Arguments arguments) {
    if (!arguments.empty()) return branch_id(document, arguments[0]);
    if (auto some = expect_selection(document); !some) return tl::unexpected(some.error());
    if (document.marks().selection.size() != 1)
        return fail(counted(document.marks().selection.size(), "branch is", "branches are") + " selected", {},
                    "select one, or give its id");
    return document.marks().selection.front();
}

// The branches in the arguments, or the selection.
Result<std::vector<int>> these_branches(const Document& document, Arguments arguments) {
    if (!arguments.empty()) {
        RAMUS_TRY(ids, branch_ids(document, arguments));
        return canonical(std::move(ids));
    }
    if (auto some = expect_selection(document); !some) return tl::unexpected(some.error());
    return document.marks().selection;
}

// "; 2 pieces now, 1 loop": if an edit changed these numbers.
std::string change_text(const tree::VesselTree& before, const tree::VesselTree& after) {
    std::string text;
    if (before.roots.size() != after.roots.size())
        text.append("; ").append(counted(after.roots.size(), "piece", "pieces")).append(" now");
    if (before.loop_count != after.loop_count)
        text.append("; ")
            .append(after.loop_count == 0 ? std::string("no loop")
                                          : counted(static_cast<std::uint64_t>(after.loop_count), "loop", "loops"))
            .append(" now");
    return text;
}

Result<Outcome> make(const ActionContext& context, const Edit& edit, const std::string& done) {
    const auto work = [edit, done, before = context.document.tree()]() -> Result<Continuation> {
        RAMUS_TRY(made, made_edit(before, edit));
        return [made = made, done](ActionContext& then) -> Result<void> {
            if (auto edited = then.document.take_edit(made); !edited) return edited;
            then.say(done + change_text(*made.before, *then.document.tree()));
            return {};
        };
    };
    return Brief{work};
}

Result<Outcome> disconnect(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(id, one_branch(context.document, arguments.first(std::min<std::size_t>(1, arguments.size()))));
    const auto fraction = arguments.size() < 2 ? 0.5 : place_in(arguments[1]);
    const auto gap = arguments.size() < 3 ? 0.0 : number_in(arguments[2], 1e-6, kFarthestMm);
    if (!fraction || !gap || arguments.size() > 3)
        return fail("disconnect takes a branch, where to cut it, and how many mm to take out", {},
                    "start, end or a fraction of its length, 0.5 unless told; mm: its diameter there unless told");
    return make(context, {Kind::kCut, {id}, {*fraction, 0.0}, *gap}, "Disconnected " + branch_word(id));
}

// The free ends of two branches that are nearest to each other.
Result<Edit> nearest_ends(const Document& document) {
    const auto& selection = document.marks().selection;
    if (selection.size() != 2)
        return fail("join takes two places, or two selected branches", {}, "join ID start|end ID start|end|FRACTION");
    const tree::VesselTree& tree = *document.tree();
    const auto degree = tree::degrees(tree);
    Edit best{Kind::kJoin, selection, {}, 0.0};
    double nearest = std::numeric_limits<double>::infinity();
    for (const double first : {0.0, 1.0})
        for (const double second : {0.0, 1.0}) {
            const auto end_of = [&](int id, double at) {
                const auto& points = tree.branches[static_cast<std::size_t>(id)].points;
                return at > 0.5 ? points.back() : points.front();
            };
            const std::uint32_t a = end_of(selection[0], first);
            const std::uint32_t b = end_of(selection[1], second);
            const double distance = glm::distance(tree.points[a].position, tree.points[b].position);
            if (degree[a] != 1 || degree[b] != 1 || distance >= nearest) continue;
            nearest = distance;
            best.fractions = {first, second};
        }
    if (!(nearest < std::numeric_limits<double>::infinity()))
        return fail("one of the two branches has no free end", {}, "select two whose ends lie open");
    return best;
}

Result<Outcome> join(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree");
    Edit edit{Kind::kJoin, {}, {}, 0.0};
    if (arguments.empty()) {
        RAMUS_TRY(found, nearest_ends(context.document));
        edit = found;
    } else {
        const auto first = arguments.size() == 4 ? place_in(arguments[1]) : std::nullopt;
        const auto second = arguments.size() == 4 ? place_in(arguments[3]) : std::nullopt;
        if (!first || !second || (*first != 0.0 && *first != 1.0))
            return fail("join takes a free end and another place", {}, "join ID start|end ID start|end|FRACTION");
        RAMUS_TRY(from, branch_id(context.document, arguments[0]));
        RAMUS_TRY(to, branch_id(context.document, arguments[2]));
        edit.branches = {from, to};
        edit.fractions = {*first, *second};
    }
    return make(context, edit, "Joined " + branch_word(edit.branches[0]) + " with " + branch_word(edit.branches[1]));
}

Result<Outcome> delete_branches(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, these_branches(context.document, arguments));
    const std::string done = "Deleted " + counted(ids.size(), "branch", "branches");
    return make(context, {Kind::kDelete, std::move(ids), {}, 0.0}, done);
}

Result<Outcome> move_root(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(id, one_branch(context.document, arguments.first(std::min<std::size_t>(1, arguments.size()))));
    const auto at = arguments.size() < 2 ? 1.0 : place_in(arguments[1]);
    if (!at || arguments.size() > 2)
        return fail("move-root takes a branch and which end of it", {}, "move-root ID start|end");
    return make(context, {Kind::kMoveRoot, {id}, {*at, 0.0}, 0.0},
                "The root is at the free end of what was " + branch_word(id));
}

Result<Outcome> flip(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("flip takes one branch");
    RAMUS_TRY(id, one_branch(context.document, arguments));
    return make(context, {Kind::kFlip, {id}, {}, 0.0}, "Turned " + branch_word(id) + " round: the root is beyond it");
}

template <Kind kind> Result<Outcome> radii(ActionContext& context, Arguments arguments) {
    constexpr bool kSets = kind == Kind::kRadius;
    if (arguments.empty() && context.window != nullptr) {
        if (auto some = expect_selection(context.document); !some) return tl::unexpected(some.error());
        context.window->ask_for_radius();
        return Done{};
    }
    const auto value = arguments.empty() ? std::nullopt : number_in(arguments[0], 1e-9, kFarthestMm);
    if (!value)
        return kSets ? fail("set-radius takes a radius in mm that is above 0", {}, "set-radius MM [ID...]")
                     : fail("scale-radius takes a factor above 0", {}, "scale-radius FACTOR [ID...]");
    RAMUS_TRY(ids, these_branches(context.document, arguments.subspan(1)));
    const std::string who = counted(ids.size(), "branch", "branches");
    return make(context, {kind, std::move(ids), {}, *value},
                kSets ? "Radius of " + who + ": " + arguments[0] + " mm"
                      : "Radii of " + who + " multiplied by " + arguments[0]);
}

bool one_to_edit(const Document& document) { return document.marks().selection.size() == 1; }
bool two_to_join(const Document& document) { return document.marks().selection.size() == 2; }

} // namespace

std::vector<Command> editing_commands() {
    return {
        Command(
            "join", "[ID start|end ID start|end|FRACTION]",
            "Joins a free end of a branch with an end or a place of another by a straight segment, the radius going "
            "from one to the other; without arguments, the nearest free ends of two selected branches. Vessels of "
            "different systems are never joined.",
            join)
            .in_menu("Edit", "Join the two selected")
            .when(two_to_join),
        Command("disconnect", "[ID [start|end|FRACTION [MM]]]",
                "Cuts a false connection: takes MM, the diameter there unless told, out of a branch at a fraction of "
                "its length, in the middle unless told. What loses its root becomes a piece with a root at the cut. "
                "Unlike cut, it changes the tree.",
                disconnect)
            .in_menu("Edit", "Disconnect the selected")
            .when(one_to_edit),
        Command("delete-spur", "[ID...]",
                "Takes branches that carry no others out of the tree, those selected unless told; the two that are "
                "left at a node become one.",
                delete_branches)
            .in_menu("Edit", "Delete the selected", {"Shift+Delete"})
            .when(has_selection),
        Command("move-root", "[ID [start|end]]",
                "Moves the root of a piece to a free end of a branch, the selected one unless told.", move_root)
            .in_menu("Edit", "Root at the selected")
            .when(one_to_edit),
        Command("flip", "[ID]",
                "Turns the direction of a branch round, the selected one unless told: the root of the piece "
                "moves to the thickest end beyond it.",
                flip)
            .in_menu("Edit", "Flip the direction")
            .when(one_to_edit),
        Command("set-radius", "[MM [ID...]]",
                "Gives branches a radius in mm, those selected unless told; nodes that they share with others keep "
                "theirs. Without arguments the window asks.",
                radii<Kind::kRadius>)
            .in_menu("Edit", "Set the diameter\xE2\x80\xA6")
            .when(has_selection),
        Command("scale-radius", "[FACTOR [ID...]]",
                "Multiplies the radii of branches, those selected unless told. Without arguments the window asks.",
                radii<Kind::kScale>),
    };
}

} // namespace ramus::app::actions
