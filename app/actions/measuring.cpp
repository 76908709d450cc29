// Measurements: taken, told, kept and drawn until they are removed.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/measured.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

constexpr const char* kWays = "distance X,Y,Z X,Y,Z, path ID ID, diameter ID [FRACTION] or angle ID";

Result<Measurement> measurement_in(const Document& document, Arguments arguments) {
    const auto refused = fail("what is to be measured?", {}, kWays);
    if (arguments.size() < 2) return refused;
    const std::string& kind = arguments[0];
    const Arguments rest = arguments.subspan(1);
    Measurement found;
    if (kind == "distance") {
        if (rest.size() != 2) return refused;
        found.kind = Measurement::Kind::kDistance;
        for (std::size_t i = 0; i < 2; ++i) {
            const auto point = numbers_in(rest[i], 3, kFarthestMm);
            if (!point) return fail("\"" + rest[i] + "\" is not a point X,Y,Z in mm");
            found.points[i] = {(*point)[0], (*point)[1], (*point)[2]};
        }
        return found;
    }
    found.kind = kind == "path"       ? Measurement::Kind::kPath
                 : kind == "diameter" ? Measurement::Kind::kDiameter
                                      : Measurement::Kind::kAngle;
    const std::size_t branches = kind == "path" ? 2 : 1;
    const std::size_t most = kind == "angle" ? 1 : 2;
    if ((kind != "path" && kind != "diameter" && kind != "angle") || rest.size() < branches || rest.size() > most)
        return refused;
    for (std::size_t i = 0; i < branches; ++i) {
        RAMUS_TRY(id, branch_id(document, rest[i]));
        found.branches[i] = id;
    }
    if (kind == "diameter" && rest.size() == 2) {
        const auto fraction = number_in(rest[1], 0.0, 1.0);
        if (!fraction)
            return fail("where on the branch?", {}, "a fraction of its length from the parent's end, 0 to 1");
        found.fraction = *fraction;
    }
    return found;
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
                "Measures, tells and keeps: distance X,Y,Z X,Y,Z (straight); path ID ID (the shortest way along the "
                "vessels "
                "from middle to middle); diameter ID [FRACTION]; angle ID (where the branch begins, to its parent's "
                "way on).",
                measure_this),
        Command("measure-selected", "",
                "Measures the way along the vessels between the two selected branches, from middle to middle.",
                measure_path_of_selection)
            .in_menu("Plan", "Measure the path between two")
            .when(two_selected),
        Command("measure-remove", "N", "Takes measurement N of the list away.", measure_remove),
        Command("measure-clear", "", "Takes all measurements away.", measure_clear)
            .in_menu("Plan", "Remove all measurements")
            .when(has_measurements),
    };
}

} // namespace ramus::app::actions
