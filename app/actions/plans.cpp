// Commands of the plans of an operation, and of cuts that are suggested.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/assets/operation.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/organ/fewest_cuts.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

// Plans are named by their number, or by their name if no other has it.
Result<std::size_t> plan_in(const Marks& marks, const std::string& word) {
    const std::vector<OperationPlan> plans = all_plans(marks);
    if (std::ranges::count(plans, word, &OperationPlan::name) == 1)
        return static_cast<std::size_t>(std::ranges::find(plans, word, &OperationPlan::name) - plans.begin());
    const std::vector<std::string> words{word};
    return list_index(words, plans.size(), "plan");
}

// "B" after "A"; "A 2" if all letters are taken.
std::string next_plan_name(const Marks& marks) {
    const std::vector<OperationPlan> plans = all_plans(marks);
    const auto taken = [&](const std::string& name) {
        return std::ranges::find(plans, name, &OperationPlan::name) != plans.end();
    };
    for (char letter = 'A'; letter <= 'Z'; ++letter)
        if (!taken(std::string(1, letter))) return std::string(1, letter);
    return "Plan " + std::to_string(plans.size() + 1);
}

Result<void> plan_copy(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("plan-copy takes a name", {}, "put quotes around a name with blanks");
    return edit(context,
                [&](Marks& marks) { copy_plan(marks, arguments.empty() ? next_plan_name(marks) : arguments[0]); });
}

Result<void> plan_use(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("plan-use takes a plan's number or name");
    RAMUS_TRY(plan, plan_in(context.document.marks(), arguments[0]));
    return edit(context, [&, plan = plan](Marks& marks) { use_plan(marks, plan); });
}

Result<void> plan_name(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 2 || arguments[1].empty()) return fail("plan-name takes a plan and its name");
    RAMUS_TRY(plan, plan_in(context.document.marks(), arguments[0]));
    return edit(context, [&, plan = plan](Marks& marks) { name_of_plan(marks, plan) = arguments[1]; });
}

Result<void> plan_compare(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("plan-compare takes a plan's number or name, or off");
    Marks next = context.document.marks();
    next.plans.compared.reset();
    if (arguments[0] != "off") {
        RAMUS_TRY(plan, plan_in(next, arguments[0]));
        if (plan == next.plans.place)
            return fail("this is the current plan", {}, "name another one to see both side by side");
        next.plans.compared = plan;
        next.comparison.mode = Comparison::Mode::kOff; // the viewports are for plans now
    }
    change_keeping_whole(context, std::move(next));
    return {};
}

Result<void> plan_remove(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("plan-remove takes a plan's number or name");
    const Marks& marks = context.document.marks();
    RAMUS_TRY(plan, plan_in(marks, arguments[0]));
    if (marks.plans.count() < 2) return fail("this is the only plan", {}, "remove its cuts and resections instead");
    return edit(context, [&, plan = plan](Marks& next) { remove_plan(next, plan); });
}

// What fewest_cuts() needs, for another thread.
struct FewestCuts {
    std::shared_ptr<const OrganSupply> supply;
    std::size_t system = 0;
    std::vector<PlannedLesion> lesions;
    double margin_mm = 0.0;
    std::size_t most = 0;
};

Result<FewestCuts> asked_fewest(const ActionContext& context, Arguments arguments) {
    constexpr std::size_t kUsualMost = 5;
    const Marks& marks = context.document.marks();
    const auto margin =
        arguments.empty() || arguments.size() > 2 ? std::nullopt : number_in(arguments[0], 0.0, kFarthestMm);
    const auto most = arguments.size() == 2 ? parsed<std::size_t>(arguments[1]) : std::optional(kUsualMost);
    if (!margin || !most || *most == 0)
        return fail("fewest-cuts takes a margin around the lesions in mm, and the largest number of cuts", {},
                    "fewest-cuts 10");
    const auto supply = wanted_supply(context.assets.organ, marks, context.assets.tree);
    if (!supply || !context.assets.organ.supply || context.assets.organ.supply->of != *supply)
        return fail("the organ is not divided yet", {}, "organ FILE reads its mask; wait for it");
    FewestCuts asked{context.assets.organ.supply, 0, planned_lesions(context.assets, marks), *margin, *most};
    if (asked.lesions.empty()) return fail("there is no lesion", {}, "lesion X,Y,Z,R places one");
    const std::vector<organ::Role> roles = roles_of(*context.assets.tree, marks);
    while (asked.system < roles.size() &&
           (roles[asked.system] != organ::Role::kSupplies || !asked.supply->reaches(asked.system)))
        ++asked.system;
    if (asked.system == roles.size())
        return fail("no vessel system supplies the organ", {}, "organ-role says which do");
    return asked;
}

organ::CutSuggestions suggested(const FewestCuts& asked) {
    const organ::Organ& organ = asked.supply->of.mask->organ;
    const std::vector<std::uint8_t> targets = voxels_in(organ, asked.lesions, asked.margin_mm);
    const std::vector<std::uint8_t> functional = functional_voxels(*asked.supply, asked.lesions);
    return organ::fewest_cuts(tree::Dependency(*asked.supply->of.tree), asked.supply->systems[asked.system], targets,
                              functional, asked.most);
}

// Makes a plan of the largest number of cuts, which loses least, and says what the others lose.
Result<void> take_fewest(ActionContext& context, const organ::CutSuggestions& found, const OrganMask& mask,
                         double margin_mm) {
    if (found.by_number.empty())
        return fail("no cut takes the supply of the lesions away", {}, "they lie outside of the organ, or in a loop");
    const Lengths lengths(mask.claims);
    std::string said;
    for (const organ::SuggestedCuts& one : found.by_number)
        said += (said.empty() ? "" : "; ") + counted(one.cuts.size(), "cut loses ", "cuts lose ") +
                lengths.volume(1000.0 * mask.organ.voxel_ml() * static_cast<double>(one.lost));
    if (found.out_of_reach > 0)
        said += "; out of reach of cuts: " +
                lengths.volume(1000.0 * mask.organ.voxel_ml() * static_cast<double>(found.out_of_reach));
    context.say(said);
    return edit(context, [&](Marks& marks) {
        copy_plan(marks, "Fewest cuts, " + rounded(margin_mm) + " mm");
        marks.cuts = found.by_number.back().cuts;
    });
}

Result<Outcome> fewest_cuts(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(wanted, asked_fewest(context, arguments));
    return Pending{"Looking for the fewest cuts", [asked = wanted](Job&) -> Result<Continuation> {
                       return [asked, found = suggested(asked)](ActionContext& then) {
                           return take_fewest(then, found, *asked.supply->of.mask, asked.margin_mm);
                       };
                   }};
}

} // namespace

std::vector<Command> plan_commands() {
    return {
        Command("plan-copy", "[NAME]", "Begins another plan as a copy of this one.", plan_copy)
            .in_menu("Plan", "Copy the plan"),
        Command("plan-use", "PLAN", "Goes to another plan, by its number or name.", plan_use),
        Command("plan-name", "PLAN NAME", "Names a plan.", plan_name),
        Command("plan-remove", "PLAN", "Removes a plan.", plan_remove),
        Command("plan-compare", "PLAN|off",
                "Shows another plan and the current one side by side, with one camera; off: the current one alone.",
                plan_compare),
        Command(
            "fewest-cuts", "MM [MOST]",
            "Suggests the cuts that take the supply of the lesions and a margin around them away and lose the least "
            "of the organ, for each number of cuts up to MOST (5); makes a plan of those that lose least.",
            fewest_cuts)
            .when(has_lesions),
    };
}

} // namespace ramus::app::actions
