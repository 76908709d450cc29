#include "app/actions/objects.h"

#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/scene_objects.h"
#include "app/session/colour_by.h"
#include "core/base/bounds.h"
#include "core/base/words.h"

#include <functional>
#include <string>
#include <vector>

namespace ramus::app::actions {

namespace {

std::vector<std::string> object_nouns() {
    std::vector<std::string> all;
    const Marks none;
    for_each_object_list(none, [&]<class T>(const std::vector<T>&) { all.emplace_back(T::kNoun); });
    return all;
}

std::string object_usage() {
    return joined(object_nouns(), "|", [](const std::string& noun) { return noun; }) + " N";
}

// Calls change(list, index) for the object in the first two arguments, as one step.
template <class Change> Result<void> change_object(ActionContext& context, Arguments arguments, const Change& change) {
    if (arguments.size() < 2)
        return fail("which object?", {}, object_usage() + ": its kind and its number in the list");
    Marks next = context.document.marks();
    Result<void> done = fail("there is no kind of object called " + arguments[0], {}, object_usage());
    for_each_object_list(next, [&]<class T>(std::vector<T>& list) {
        if (arguments[0] != T::kNoun) return;
        const auto index = list_index(arguments.subspan(1, 1), list.size(), arguments[0]);
        done = index ? Result<void>{} : tl::unexpected(index.error());
        if (index) change(next, list, *index);
    });
    if (done) context.document.change(std::move(next));
    return done;
}

Result<void> switch_object(ActionContext& context, Arguments arguments, bool visible) {
    if (arguments.size() > 2) return fail("an object is shown or hidden by its kind and number", {}, object_usage());
    return change_object(context, arguments,
                         [&](Marks&, auto& list, std::size_t index) { list[index].visible = visible; });
}

Result<void> name_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() == 2 && context.window != nullptr) {
        std::string now;
        auto found =
            change_object(context, arguments, [&](Marks&, auto& list, std::size_t index) { now = list[index].name; });
        if (found) context.window->ask_for_object_name(arguments[0], arguments[1], now);
        return found;
    }
    if (arguments.size() != 3)
        return fail("object-name takes a kind, a number and a name", {}, object_usage() + " NAME");
    return change_object(context, arguments,
                         [&](Marks&, auto& list, std::size_t index) { list[index].name = arguments[2]; });
}

Result<void> centre_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 2) return fail("which object?", {}, object_usage());
    refresh(context.assets, context.document);
    std::vector<glm::vec3> points;
    auto found = change_object(context, arguments, [&](Marks&, auto& list, std::size_t index) {
        add_points(points, context.assets, list[index]);
    });
    if (!found) return found;
    if (points.empty()) return fail("it has no place yet", {}, "its file is not read, or it cannot be measured");
    const Bounds<glm::vec3> box = box_of_points(points);
    const glm::dvec3 middle = 0.5F * (box.least + box.most);
    return move_camera(context, render::centred_on(context.document.session().camera, middle));
}

bool has_objects(const Document& document) {
    bool any = false;
    for_each_object_list(document.marks(), [&](const auto& list) { any = any || !list.empty(); });
    return any;
}

} // namespace

CommandAction for_kind(std::string_view kind, Result<void> (*action)(ActionContext&, Arguments)) {
    return [kind = std::string(kind), action](ActionContext& context, Arguments arguments) {
        std::vector<std::string> words{kind};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return action(context, words);
    };
}

Result<void> show_object(ActionContext& context, Arguments arguments) {
    return switch_object(context, arguments, true);
}
Result<void> hide_object(ActionContext& context, Arguments arguments) {
    return switch_object(context, arguments, false);
}

Result<void> colour_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 3)
        return fail("object-colour takes a kind, a number and a colour", {}, object_usage() + " RRGGBB");
    const auto colour = colour_in(arguments[2]);
    if (!colour) return fail("\"" + arguments[2] + "\" is not a colour", {}, "RRGGBB: c98268, say");
    return change_object(context, arguments,
                         [&](Marks&, auto& list, std::size_t index) { list[index].colour = *colour; });
}

Result<void> fade_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 3)
        return fail("object-opacity takes a kind, a number and an opacity", {}, object_usage() + " X");
    const auto opacity = number_in(arguments[2], 0.0, 1.0);
    if (!opacity) return fail("an opacity goes from 0 to 1");
    bool surface = false;
    Result<void> done =
        change_object(context, arguments, [&]<class T>(Marks&, std::vector<T>& list, std::size_t index) {
            if constexpr (SurfaceObject<T>) {
                list[index].opacity = *opacity;
                surface = true;
            }
        });
    return done && !surface ? fail("a " + arguments[0] + " is no surface and has no opacity") : done;
}

Result<void> remove_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 2) return fail("an object is removed by its kind and number", {}, object_usage());
    std::size_t gone = 0;
    auto removed = change_object(context, arguments, [&](Marks& marks, auto& list, std::size_t index) {
        gone = app::remove_object(marks, list, index);
    });
    if (removed && gone > 0)
        context.say("Removed with " + counted(gone, "measurement", "measurements") + " from the " + arguments[0]);
    return removed;
}

std::vector<Command> object_commands() {
    return {
        Command("object-show", "KIND N", "Shows an object that was hidden: " + object_usage() + ".", show_object)
            .when(has_objects),
        Command("object-hide", "KIND N", "Hides an object, and keeps it: " + object_usage() + ".", hide_object)
            .when(has_objects),
        Command("object-name", "KIND N [NAME]", "Gives an object a name; an empty one takes it away.", name_object)
            .when(has_objects),
        Command("object-colour", "KIND N RRGGBB", "The colour of an object.", colour_object).when(has_objects),
        Command("object-opacity", "KIND N X", "How dense a lesion or a context mesh is, from 0 to 1, which is solid.",
                fade_object)
            .when(has_objects),
        Command("object-centre", "KIND N", "Brings an object into the middle of the picture.", centre_object)
            .when(has_objects),
        Command("object-remove", "KIND N", "Removes an object.", remove_object).when(has_objects),
    };
}

} // namespace ramus::app::actions
