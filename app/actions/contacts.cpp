// Contacts: where vessels press on each other without being connected there.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/fit.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

constexpr std::string_view kWipe = "wipe";

Result<void> contacts(ActionContext& context, Arguments) { return toggle_part(context, "contacts"); }

// Turns the camera about the contact by the smallest angle that shows both vessels side by side.
render::Camera facing(render::Camera camera, const tree::Contact& contact) {
    const glm::dvec3 between = contact.sides[1].at - contact.sides[0].at;
    if (glm::length(between) < 1e-6 * contact.sides[0].radius) return camera;
    const glm::dvec3 across = glm::normalize(between);
    const render::CameraAxes axes = render::axes_of(camera);
    glm::dvec3 forward = axes.forward - glm::dot(axes.forward, across) * across;
    constexpr double kAlong = 1e-3; // looking along it: any perpendicular direction is valid
    if (glm::length(forward) < kAlong) forward = axes.right - glm::dot(axes.right, across) * across;
    forward = glm::normalize(forward);
    camera.position = camera.focal_point - glm::distance(camera.position, camera.focal_point) * forward;
    // Keeps view-up unless it is parallel to the new line of sight.
    if (glm::length(glm::cross(axes.up, forward)) < kAlong) camera.view_up = axes.forward;
    return camera;
}

// Shows vessels apart and merged as a wipe, with the line through the contact in the middle.
void wipe_both_ways(Document& document) {
    Marks next = document.marks();
    next.comparison.mode = Comparison::Mode::kWipe;
    next.comparison.surfaces = {Compared::kMerged, Compared::kApart};
    next.comparison.wipe = Comparison{}.wipe;
    document.change(std::move(next));
}

// Uses the contacts of the document's current state.
Result<void> go_to(ActionContext& context, Arguments arguments) {
    const bool wipes = arguments.size() == 2 && arguments[1] == kWipe;
    const auto list = context.assets.contacts.list;
    RAMUS_TRY(index, list_index(wipes ? arguments.first(1) : arguments, list->size(), "contact"));
    const tree::Contact& chosen = (*list)[index];
    constexpr double kNearer = 0.5; // closer than for a whole vessel: gaps are small
    const double radius = std::max(chosen.sides[0].radius, chosen.sides[1].radius);
    select_these(context, app::branches_of(chosen));
    if (wipes) wipe_both_ways(context.document);
    if (context.window != nullptr) context.window->show_contact(static_cast<int>(index));
    const render::Camera near =
        looking_at(context.document.session().camera, chosen.at(), kNearer * radius, context.picture.picture_size());
    return move_camera(context, facing(near, chosen));
}

Result<Outcome> contact(ActionContext& context, Arguments arguments) {
    const auto& tree = context.document.tree();
    if (!tree) return fail("there is no tree");
    const mesh::SurfaceOptions& options = context.document.marks().options;
    refresh(context.assets, context.document);
    if (!contacts_awaited(context.assets, options)) return outcome_of(go_to(context, arguments));
    return Pending{
        "Looking for contacts",
        [tree, options, words = std::vector(arguments.begin(), arguments.end())](Job&) -> Result<Continuation> {
            return [tree, words, found = contacts_of(*tree, options)](ActionContext& then) -> Result<void> {
                if (then.document.tree() != tree || !found.fits(then.document.marks().options))
                    return fail("the tree or its surface has changed meanwhile", {}, "ask again");
                refresh(then.assets, then.document);
                then.assets.contacts = found;
                return go_to(then, words);
            };
        }};
}

Result<void> contact_marks(ActionContext& context, Arguments arguments) {
    const auto shown = switched(arguments, context.document.marks().contact_marks);
    if (!shown) return fail("contact-marks is on or off");
    return edit(context, [&](Marks& marks) { marks.contact_marks = *shown; });
}

} // namespace

std::vector<Command> contact_commands() {
    return {
        Command("contacts", "",
                "Shows or hides the list of contacts: where vessels press on each other without being connected there.",
                contacts)
            .in_menu("View", "Contacts", {"Shift+T"})
            .in_submenu("Panels")
            .when(has_tree)
            .in_use_when(shows_part("contacts")),
        Command("contact", "N [wipe]",
                "Goes to the N-th contact, the closest is the first, and selects the branches that touch there; wipe: "
                "with the vessels merged left of a line, and apart right of it.",
                contact)
            .when(has_tree),
        Command("contact-marks", "[on|off]",
                "Marks every contact in the picture: yellow where vessels overlap, else blue.", contact_marks)
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
