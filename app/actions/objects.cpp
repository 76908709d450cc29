// Commands for objects of the scene of any kind: show, hide, name, remove.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "core/base/words.h"

#include <algorithm>
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

template <bool visible> Result<void> show_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 2) return fail("an object is shown or hidden by its kind and number", {}, object_usage());
    return change_object(context, arguments,
                         [](Marks&, auto& list, std::size_t index) { list[index].visible = visible; });
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

Result<void> take_object(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 2) return fail("an object is removed by its kind and number", {}, object_usage());
    std::size_t gone = 0;
    auto removed = change_object(context, arguments, [&](Marks& marks, auto& list, std::size_t index) {
        gone = remove_object(marks, list, index);
    });
    if (removed && gone > 0)
        context.say("Removed with " + counted(gone, "measurement", "measurements") + " from the " + arguments[0]);
    return removed;
}

bool has_objects(const Document& document) {
    bool any = false;
    for_each_object_list(document.marks(), [&](const auto& list) { any = any || !list.empty(); });
    return any;
}

} // namespace

std::vector<Command> object_commands() {
    return {
        Command("object-show", "KIND N", "Shows an object that was hidden: " + object_usage() + ".", show_object<true>)
            .when(has_objects),
        Command("object-hide", "KIND N", "Hides an object, and keeps it: " + object_usage() + ".", show_object<false>)
            .when(has_objects),
        Command("object-name", "KIND N [NAME]", "Gives an object a name; an empty one takes it away.", name_object)
            .when(has_objects),
        Command("object-remove", "KIND N", "Removes an object.", take_object).when(has_objects),
    };
}

} // namespace ramus::app::actions
