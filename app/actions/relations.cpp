// Commands that select branches by relations and by properties.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/session/numbers.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

const tree::Branch& branch_of(const Document& document, int id) {
    return document.tree()->branches[static_cast<std::size_t>(id)];
}

// Selects `ids`; fails if there are none.
Result<void> select_found(ActionContext& context, std::vector<int> ids, const std::string& missing) {
    if (ids.empty()) return fail(missing);
    return select_these(context, std::move(ids));
}

// A selection by value may be empty; reports its size.
Result<void> select_and_say(ActionContext& context, std::vector<int> ids, const std::string& what) {
    context.say("Selected " + counted(ids.size(), "branch", "branches") + " " + what);
    return select_these(context, std::move(ids));
}

Result<void> select_parent(ActionContext& context, Arguments) {
    if (auto some = expect_selection(context.document); !some) return some;
    std::vector<int> ids;
    for (const int id : context.document.marks().selection)
        if (const int parent = branch_of(context.document, id).parent; parent != tree::kNoBranch) ids.push_back(parent);
    return select_found(context, std::move(ids), "there is nothing between the selected branches and the root");
}

Result<void> select_children(ActionContext& context, Arguments) {
    if (auto some = expect_selection(context.document); !some) return some;
    std::vector<int> ids;
    for (const int id : context.document.marks().selection) {
        const auto& children = branch_of(context.document, id).children;
        ids.insert(ids.end(), children.begin(), children.end());
    }
    return select_found(context, std::move(ids), "nothing branches off the selected branches");
}

Result<void> select_siblings(ActionContext& context, Arguments) {
    const Document& document = context.document;
    if (auto some = expect_selection(document); !some) return some;
    std::vector<char> here(document.tree()->points.size(), 0);
    for (const int id : document.marks().selection) here[branch_of(document, id).points.front()] = 1;
    std::vector<int> ids;
    for (const int id : unselected(document))
        if (here[branch_of(document, id).points.front()] != 0) ids.push_back(id);
    return select_found(context, std::move(ids), "no other branch begins where the selected ones do");
}

std::vector<int> of_generations(const Document& document, auto&& wanted) {
    return branches_where(static_cast<std::size_t>(document.branch_count()),
                          [&](std::size_t id) { return wanted(document.tree()->branches[id].generation); });
}

Result<void> select_same_generation(ActionContext& context, Arguments) {
    const Document& document = context.document;
    if (auto some = expect_selection(document); !some) return some;
    std::vector<int> generations;
    for (const int id : document.marks().selection) generations.push_back(branch_of(document, id).generation);
    generations = canonical(std::move(generations));
    select_these(context, of_generations(document, [&](int generation) {
                     return std::ranges::binary_search(generations, generation);
                 }));
    return {};
}

Result<void> select_generation(ActionContext& context, Arguments arguments) {
    constexpr double kMost = 1e9;
    const auto least =
        arguments.empty() || arguments.size() > 2 ? std::nullopt : number_in(arguments.front(), 0.0, kMost);
    const auto most = least ? number_in(arguments.back(), *least, kMost) : std::nullopt;
    if (!most || *least != static_cast<int>(*least) || *most != static_cast<int>(*most))
        return fail("select-generation takes one generation, or the first and the last", {},
                    "whole numbers; 0 is that of the roots");
    auto ids = of_generations(context.document, [&](int g) { return g >= *least && g <= *most; });
    return select_and_say(context, std::move(ids),
                          *least == *most ? "of generation " + arguments[0]
                                          : "of generations " + arguments[0] + " to " + arguments[1]);
}

Result<void> select_diameter(ActionContext& context, Arguments arguments) {
    const auto least = arguments.size() == 2 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    const auto most = least ? number_in(arguments[1], *least, kFarthestMm) : std::nullopt;
    if (!most) return fail("select-diameter takes the least and the largest mean diameter in mm");
    auto ids = branches_where(static_cast<std::size_t>(context.document.branch_count()), [&](std::size_t id) {
        const double diameter = context.document.facts()->branches[id].diameter_mm.mean;
        return diameter >= *least && diameter <= *most;
    });
    return select_and_say(context, std::move(ids), "of " + arguments[0] + " to " + arguments[1] + " mm diameter");
}

Result<void> select_closer(ActionContext& context, double reach, const std::vector<double>& distances,
                           const std::string& what) {
    auto ids = branches_where(distances.size(), [&](std::size_t id) { return distances[id] <= reach; });
    return select_and_say(context, std::move(ids), "within " + what);
}

Result<void> select_by_plan(ActionContext& context, double reach, const Plan& plan, const std::string& what) {
    if (plan.lesion_distances_mm.empty())
        return plan.troubles.empty() ? fail("there is no lesion", {}, "place one first, or give a point X,Y,Z")
                                     : fail(plan.troubles.front());
    return select_closer(context, reach, plan.lesion_distances_mm, what);
}

Result<Outcome> select_within(ActionContext& context, Arguments arguments) {
    const Document& document = context.document;
    if (!has_tree(document)) return fail("there is no tree");
    const auto reach =
        arguments.empty() || arguments.size() > 2 ? std::nullopt : number_in(arguments[0], 0.0, kFarthestMm);
    const auto point = arguments.size() == 2 ? numbers_in(arguments[1], 3, kFarthestMm) : std::nullopt;
    if (!reach || (arguments.size() == 2 && !point))
        return fail("select-within takes a distance in mm, and may take a point X,Y,Z to count from");
    if (point) {
        const measure::Lesions at{{{(*point)[0], (*point)[1], (*point)[2], 0.0}}, {}};
        return outcome_of(select_closer(context, *reach, measure::wall_distances(*document.tree(), at),
                                        arguments[0] + " mm of the point"));
    }
    const std::string what = arguments[0] + " mm of the lesions";
    const Plan& plan = refresh_plan(context.assets, document);
    if (!plan.measuring) return outcome_of(select_by_plan(context, *reach, plan, what));
    return Pending{"Measuring distances",
                   [assets = context.assets, marks = document.marks(), reach = *reach,
                    what](Job&) mutable -> Result<Continuation> {
                       complete_lesions(assets, marks, GridIs::kMadeWhenShown);
                       return [assets, plan = make_plan(assets, marks), reach, what](ActionContext& then) mutable {
                           assets.lesion_grid = then.assets.lesion_grid; // computed elsewhere
                           merge(then.assets, assets);
                           return select_by_plan(then, reach, plan, what);
                       };
                   }};
}

} // namespace

std::vector<Command> relation_commands() {
    return {
        Command("select-parent", "", "Selects the branches that the selected ones come from, instead of them.",
                select_parent)
            .in_menu("Select", "Parent", {"["})
            .when(has_selection),
        Command("select-children", "", "Selects the branches that come from the selected ones, instead of them.",
                select_children)
            .in_menu("Select", "Children", {"]"})
            .when(has_selection),
        Command("select-siblings", "",
                "Selects the other branches that begin where the selected ones do, instead of them.", select_siblings)
            .in_menu("Select", "Siblings")
            .when(has_selection),
        Command("select-same-generation", "", "Selects all branches of the selected ones' generations.",
                select_same_generation)
            .in_menu("Select", "Same generation")
            .when(has_selection),
        Command("select-generation", "N [M]",
                "Selects the branches of generation N, or of N to M; 0 is that of the roots.", select_generation),
        Command("select-diameter", "MIN MAX", "Selects the branches of a mean diameter of MIN to MAX mm.",
                select_diameter),
        Command("select-within", "MM [X,Y,Z]",
                "Selects the branches whose wall is at most MM from the lesions, or from a point.", select_within),
        Command("select-within", "MM", "Selects the branches whose wall is at most 10 mm from the lesions.",
                select_within)
            .in_menu("Select", "Within 10 mm of the lesions")
            .giving({"10"})
            .when(has_lesions),
    };
}

} // namespace ramus::app::actions
