// Commands of the validation: show its findings, and move the camera to them.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/fit.h"
#include "app/workspace/validation_maker.h"

namespace ramus::app::actions {

namespace {

Result<void> validation(ActionContext& context, Arguments) { return toggle_part(context, "validation"); }

// Uses the findings for the document's current state.
Result<void> go_to_finding(ActionContext& context, Arguments arguments) {
    const auto list = context.assets.validation.findings;
    RAMUS_TRY(index, list_index(arguments, list->size(), "finding"));
    const Finding& chosen = (*list)[index];
    select_these(context, chosen.branches);
    if (context.window != nullptr) context.window->show_finding(static_cast<int>(index));
    return move_camera(context, looking_at(context.document.session().camera, chosen.at, chosen.radius_mm,
                                           context.picture.picture_size()));
}

Result<Outcome> finding(ActionContext& context, Arguments arguments) {
    if (!context.document.tree()) return fail("there is no tree");
    ValidationOf of = validation_of(context.document.tree(), context.document.marks());
    refresh(context.assets, context.document);
    if (context.assets.validation.fits(of)) return outcome_of(go_to_finding(context, arguments));
    return Pending{"Validating the surface",
                   [of, words = std::vector(arguments.begin(), arguments.end())](Job& job) -> Result<Continuation> {
                       RAMUS_TRY(made, make_validation(of, job));
                       return [words, made](ActionContext& then) -> Result<void> {
                           if (!made.fits(validation_of(then.document.tree(), then.document.marks())))
                               return fail("the tree or its surface has changed meanwhile", {}, "ask again");
                           refresh(then.assets, then.document);
                           then.assets.validation = made;
                           return go_to_finding(then, words);
                       };
                   }};
}

} // namespace

std::vector<Command> validation_commands() {
    return {
        Command("validation", "",
                "Shows or hides what comparing the surface with the tree finds: branches that are lost, false or "
                "merged, changed constrictions, radii.",
                validation)
            .in_menu("View", "Validation", {"Shift+V"})
            .in_submenu("Panels")
            .when(has_tree)
            .in_use_when(shows_part("validation")),
        Command("finding", "N",
                "Goes to the N-th finding of the validation, and selects the branches that it is about.", finding)
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
