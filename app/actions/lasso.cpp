// Selecting by a line drawn around vessels, and how that is done by hand.
#include "app/tools/lasso.h"

#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/numbers.h"
#include "app/tools/tool.h"
#include "app/workspace/surface_maker.h"

#include <algorithm>
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
    const std::size_t comma = word.find(',');
    if (comma == std::string::npos) return {};
    const auto x = number_in(word.substr(0, comma), -kFarthest, kFarthest);
    const auto y = number_in(word.substr(comma + 1), -kFarthest, kFarthest);
    if (!x || !y) return {};
    return glm::dvec2(*x, *y);
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

Result<void> lasso(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(wanted, read(arguments));
    if (!context.document.tree()) return fail("there is no tree to lasso");
    std::optional<render::BranchPicture> picture;
    if (wanted.visible) {
        RAMUS_TRY(taken, context.picture.branch_picture());
        picture = std::move(taken);
    }
    const Document& document = context.document;
    const LassoRule rule{.any_part = wanted.any_part, .visible = picture ? &*picture : nullptr};
    const std::vector<int> hidden = branches_in_state(document.marks(), render::BranchState::kHidden);
    std::vector<int> inside =
        branches_inside(*document.tree(), document.session().camera, context.picture.picture_size(),
                        PixelPolygon(std::move(wanted.corners)), rule,
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
    select_these(context.document, std::move(next));
    context.say(count + " inside the lasso" + (more ? "; D takes all that depends on the selection" : ""));
    return {};
}

Result<void> set_switch(ActionContext& context, Arguments arguments, std::string_view command,
                        const std::array<std::string_view, 2>& values, bool ToolSettings::*setting) {
    const auto found = arguments.size() == 1 ? std::ranges::find(values, arguments[0]) : values.end();
    if (found == values.end())
        return fail(std::string(command) + " is " + std::string(values[0]) + " or " + std::string(values[1]));
    if (context.tools == nullptr)
        return fail("there is no lasso in hand without a window", {}, "give lasso --any or --visible");
    context.tools->tool_settings().*setting = found != values.begin();
    return {};
}

Result<void> lasso_mode(ActionContext& context, Arguments arguments) {
    return set_switch(context, arguments, "lasso-mode", {"half", "any"}, &ToolSettings::lasso_any_part);
}

Result<void> lasso_depth(ActionContext& context, Arguments arguments) {
    return set_switch(context, arguments, "lasso-depth", {"through", "visible"}, &ToolSettings::lasso_visible);
}

bool is_mode(const ActionContext& context, const Command& entry) {
    return context.tools != nullptr && context.tools->tool_settings().lasso_any_part == (entry.preset.front() == "any");
}

bool is_depth(const ActionContext& context, const Command& entry) {
    return context.tools != nullptr &&
           context.tools->tool_settings().lasso_visible == (entry.preset.front() == "visible");
}

Command lasso_mode_entry(const char* value, const char* label, const char* help) {
    return Command("lasso-mode", "", help, lasso_mode).in_menu("Tools", label).giving({value}).in_use_when(is_mode);
}

Command lasso_depth_entry(const char* value, const char* label, const char* help) {
    return Command("lasso-depth", "", help, lasso_depth).in_menu("Tools", label).giving({value}).in_use_when(is_depth);
}

} // namespace

std::vector<Command> lasso_commands() {
    return {
        Command("lasso", "[--any] [--visible] [--add|--remove] X,Y X,Y X,Y...",
                "Selects what lies inside a polygon of pixels: branches with at least half their length inside, or any "
                "part.",
                lasso),
        Command("lasso-mode", "half|any", "What a lasso takes: at least half a branch, or any part of it.", lasso_mode),
        Command("lasso-depth", "through|visible", "Whether a lasso takes what lies behind, or only what is visible.",
                lasso_depth),
        lasso_mode_entry("half", "Lasso at least half", "A branch is in with at least half its length."),
        lasso_mode_entry("any", "Lasso any part", "A branch is in with any part of it."),
        lasso_depth_entry("through", "Lasso through the tree", "What lies behind is taken too."),
        lasso_depth_entry("visible", "Lasso what is visible", "Only what can be seen is taken."),
    };
}

} // namespace ramus::app::actions
