// Commands of the lasso, and its settings.
#include "app/tools/lasso.h"

#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/numbers.h"
#include "app/tools/tool.h"
#include "app/workspace/surface_maker.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <iterator>
#include <optional>
#include <utility>

namespace ramus::app::actions {

namespace {

struct LassoArguments {
    bool any_part = false, visible = false, add = false, remove = false;
    std::vector<glm::dvec2> corners;
};

std::optional<glm::dvec2> pixel(const std::string& word) {
    constexpr double kFarthest = 1e6; // far outside of any picture, and still exact
    const auto numbers = numbers_in(word, 2, kFarthest);
    return numbers ? std::optional(glm::dvec2((*numbers)[0], (*numbers)[1])) : std::nullopt;
}

Result<LassoArguments> read(Arguments arguments) {
    LassoArguments read;
    for (const std::string& word : arguments) {
        if (word.starts_with("--")) {
            bool* flag = word == "--any"       ? &read.any_part
                         : word == "--visible" ? &read.visible
                         : word == "--add"     ? &read.add
                         : word == "--remove"  ? &read.remove
                                               : nullptr;
            if (flag == nullptr) return fail("lasso has no option " + word, {}, "--any, --visible, --add or --remove");
            *flag = true;
        } else if (const auto corner = pixel(word)) {
            read.corners.push_back(*corner);
        } else {
            return fail("\"" + word + "\" is not a pixel such as 120,80");
        }
    }
    if (read.corners.size() < 3)
        return fail("lasso takes at least three corners", {}, "pixels of the picture from its upper left: X,Y X,Y X,Y");
    if (read.add && read.remove) return fail("lasso adds or removes, not both");
    return read;
}

// The picture under the lasso.
struct LassoView {
    render::Camera camera;
    glm::ivec2 size{1};
};

// `visible`: the branches in the picture; null: also selects hidden parts.
Result<void> select_inside(ActionContext& context, const LassoArguments& wanted, const LassoView& view,
                           const render::BranchPicture* visible) {
    const Document& document = context.document;
    if (!document.tree()) return fail("there is no tree to lasso");
    const LassoRule rule{.any_part = wanted.any_part, .visible = visible};
    const std::vector<int> hidden = branches_in_state(document.marks(), tree::BranchState::kHidden);
    std::vector<int> inside =
        branches_inside(*document.tree(), view.camera, view.size, PixelPolygon(wanted.corners), rule,
                        hidden_flags(hidden, static_cast<std::size_t>(document.branch_count())));
    const std::string count = counted(inside.size(), "branch", "branches");
    const auto& selection = document.marks().selection;
    std::vector<int> next;
    if (wanted.add)
        std::ranges::set_union(selection, inside, std::back_inserter(next));
    else if (wanted.remove)
        std::ranges::set_difference(selection, inside, std::back_inserter(next));
    else
        next = std::move(inside);
    const bool more = !next.empty() && !wanted.remove;
    select_these(context, std::move(next));
    context.say(count + " inside the lasso" + (more ? "; D takes all that depends on the selection" : ""));
    return {};
}

Result<Outcome> lasso(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(wanted, read(arguments));
    if (!context.document.tree()) return fail("there is no tree to lasso");
    const LassoView view{context.document.session().camera, context.picture.picture_size()};
    if (!wanted.visible) return outcome_of(select_inside(context, wanted, view, nullptr));
    const auto coming = context.picture.deferred_branch_picture();
    const auto select = [coming, wanted, view](ActionContext& then) -> Result<void> {
        RAMUS_TRY(picture, coming.take());
        return select_inside(then, wanted, view, &picture);
    };
    return Awaited{coming.ready, select};
}

// A setting of the lasso tool with two values.
struct Switch {
    std::string name, values, help;
    bool ToolSettings::*setting;
    struct {
        std::string value, label, help;
    } entries[2]; // off, on
};

const std::array<Switch, 2> kSwitches{
    {{"lasso-mode",
      "half|any",
      "What a lasso takes: at least half a branch, or any part of it.",
      &ToolSettings::lasso_any_part,
      {{"half", "Lasso at least half", "A branch is in with at least half its length."},
       {"any", "Lasso any part", "A branch is in with any part of it."}}},
     {"lasso-depth",
      "through|visible",
      "Whether a lasso takes what lies behind, or only what is visible.",
      &ToolSettings::lasso_visible,
      {{"through", "Lasso through the tree", "What lies behind is taken too."},
       {"visible", "Lasso what is visible", "Only what can be seen is taken."}}}}};

CommandAction setting(const Switch& one) {
    return [&one](ActionContext& context, Arguments arguments) -> Result<void> {
        const auto& [off, on] = one.entries;
        if (arguments.size() != 1 || (arguments[0] != off.value && arguments[0] != on.value))
            return fail(one.name + " is " + off.value + " or " + on.value);
        if (context.tools == nullptr)
            return fail("there is no lasso in hand without a window", {}, "give lasso --any or --visible");
        context.tools->tool_settings().*one.setting = arguments[0] == on.value;
        return {};
    };
}

} // namespace

std::vector<Command> lasso_commands() {
    std::vector<Command> commands{
        Command("lasso", "[--any] [--visible] [--add|--remove] X,Y X,Y X,Y...",
                "Selects what lies inside a polygon of pixels: branches with at least half their length inside, or any "
                "part.",
                lasso)};
    for (const Switch& one : kSwitches) commands.emplace_back(one.name, one.values, one.help, setting(one));
    for (const Switch& one : kSwitches)
        for (const auto& entry : one.entries)
            commands.push_back(Command(one.name, "", entry.help, setting(one))
                                   .in_menu("Tools", entry.label)
                                   .giving({entry.value})
                                   .in_use_when([&one](const ActionContext& context, const Command& of) {
                                       return context.tools != nullptr && context.tools->tool_settings().*one.setting ==
                                                                              (of.preset[0] == one.entries[1].value);
                                   }));
    return commands;
}

} // namespace ramus::app::actions
