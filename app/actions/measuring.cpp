// Measurements: taken, told, kept and drawn until they are removed.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/measured.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace ramus::app::actions {

namespace {

constexpr const char* kKinds = "distance X,Y,Z X,Y,Z, path ID FRACTION ID FRACTION, diameter ID FRACTION, "
                               "angle ID FRACTION ID FRACTION ID FRACTION, or angle ID";
constexpr std::array<std::pair<std::string_view, Measurement::Kind>, 4> kKindNames{
    {{"distance", Measurement::Kind::kDistance},
     {"path", Measurement::Kind::kPath},
     {"diameter", Measurement::Kind::kDiameter},
     {"angle", Measurement::Kind::kAngle}}};

Result<Measurement> points_in(Arguments words) {
    Measurement found;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto point = numbers_in(words[i], 3, kFarthestMm);
        if (!point) return fail("\"" + words[i] + "\" is not a point X,Y,Z in mm");
        found.points[i] = {(*point)[0], (*point)[1], (*point)[2]};
    }
    return found;
}

// ID FRACTION ID FRACTION, or ID ID for the middles of branches.
Result<Measurement> places_in(const Document& document, Measurement::Kind kind, Arguments words, bool with_fractions) {
    Measurement found{.kind = kind};
    const std::size_t step = with_fractions ? 2 : 1;
    for (std::size_t i = 0; i < words.size() / step; ++i) {
        RAMUS_TRY(id, branch_id(document, words[step * i]));
        found.places[i].branch = id;
        if (!with_fractions) continue;
        const auto fraction = number_in(words[step * i + 1], 0.0, 1.0);
        if (!fraction)
            return fail("where on the branch?", {}, "a fraction of its length from the parent's end, 0 to 1");
        found.places[i].fraction = *fraction;
    }
    return found;
}

Result<Measurement> measurement_in(const Document& document, Arguments arguments) {
    const auto refused = fail("what is to be measured?", {}, kKinds);
    const auto* kind = arguments.empty() ? kKindNames.end()
                                         : std::ranges::find(kKindNames, std::string_view(arguments[0]),
                                                             &decltype(kKindNames)::value_type::first);
    if (kind == kKindNames.end()) return refused;
    const Arguments rest = arguments.subspan(1);
    switch (kind->second) {
    case Measurement::Kind::kDistance:
        return rest.size() == 2 ? points_in(rest) : refused;
    case Measurement::Kind::kPath:
        if (rest.size() == 2 || rest.size() == 4) return places_in(document, kind->second, rest, rest.size() == 4);
        return refused;
    case Measurement::Kind::kDiameter:
        if (rest.size() == 1 || rest.size() == 2) return places_in(document, kind->second, rest, rest.size() == 2);
        return refused;
    case Measurement::Kind::kAngle:
        if (rest.size() == 1 || rest.size() == 6) return places_in(document, kind->second, rest, rest.size() == 6);
        return refused;
    }
    return refused;
}

Result<void> measure_this(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree to measure");
    RAMUS_TRY(wanted, measurement_in(context.document, arguments));
    RAMUS_TRY(found, measured(*context.document.tree(), wanted));
    Marks next = context.document.marks();
    if (std::ranges::find(next.measurements, wanted) == next.measurements.end()) next.measurements.push_back(wanted);
    if (auto few = check_counts(next); !few) return few;
    context.document.change(std::move(next));
    context.say(found.sentence());
    return {};
}

// What is measured stays of its kind and in its place in the list.
Result<void> measure_change(ActionContext& context, Arguments arguments) {
    if (arguments.size() < 2)
        return fail("measure-change takes the number of a measurement and another one", {}, kKinds);
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().measurements.size(), "measurement"));
    RAMUS_TRY(wanted, measurement_in(context.document, arguments.subspan(1)));
    RAMUS_TRY(found, measured(*context.document.tree(), wanted));
    context.say(found.sentence());
    return edit(context, [&, index = index](Marks& marks) { marks.measurements[index] = wanted; });
}

Result<void> measure_remove(ActionContext& context, Arguments arguments) {
    return remove_from(context, arguments, &Marks::measurements, "measurement");
}

Result<void> measure_clear(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.measurements.clear(); });
}

// The last two of the selection, for there is no order in it but that of ids.
Result<void> measure_path_of_selection(ActionContext& context, Arguments) {
    const auto& selection = context.document.marks().selection;
    if (selection.size() != 2) return fail("a path is measured between two selected branches", {}, "select two");
    const std::vector<std::string> words{"path", std::to_string(selection[0]), std::to_string(selection[1])};
    return measure_this(context, words);
}

bool two_selected(const Document& document) { return document.marks().selection.size() == 2; }
bool has_measurements(const Document& document) { return !document.marks().measurements.empty(); }

} // namespace

std::vector<Command> measure_commands() {
    return {
        Command("measure", "KIND ...",
                "Measures, tells and keeps: distance X,Y,Z X,Y,Z (straight); path ID FRACTION ID FRACTION (the "
                "shortest along the vessels; ID ID from middle to middle); diameter ID [FRACTION]; angle of three "
                "times ID FRACTION (at the second place), or of one ID (where the branch begins, to its parent's way "
                "on). A FRACTION is of the branch's length, from the parent's end.",
                measure_this),
        Command("measure-change", "N KIND ...", "Gives measurement N of the list other places.", measure_change),
        Command("measure-selected", "",
                "Measures the path along the vessels between the two selected branches, from middle to middle.",
                measure_path_of_selection)
            .in_menu("Plan", "Measure the path between the two selected")
            .when(two_selected),
        Command("measure-remove", "N", "Takes measurement N of the list away.", measure_remove),
        Command("measure-clear", "", "Takes all measurements away.", measure_clear)
            .in_menu("Plan", "Remove all measurements")
            .when(has_measurements),
    };
}

} // namespace ramus::app::actions
