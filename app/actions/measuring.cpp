// Commands of measurements: taken, reported, kept and drawn until removed.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/assets/measured.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace ramus::app::actions {

namespace {

constexpr const char* kKinds = "distance END END (X,Y,Z; lesion:N@X,Y,Z), distance lesion:N branch:ID, path ID "
                               "FRACTION ID FRACTION, diameter ID FRACTION, "
                               "angle ID FRACTION ID FRACTION ID FRACTION, or angle ID";
constexpr std::array<std::pair<std::string_view, Measurement::Kind>, 4> kKindNames{
    {{"distance", Measurement::Kind::kDistance},
     {"path", Measurement::Kind::kPath},
     {"diameter", Measurement::Kind::kDiameter},
     {"angle", Measurement::Kind::kAngle}}};

constexpr std::string_view kLesion = "lesion:", kBranch = "branch:";

Result<int> lesion_in(const Document& document, std::string_view number) { // its id
    const std::vector<std::string> words{std::string(number)};
    const std::vector<Lesion>& lesions = document.marks().lesions;
    RAMUS_TRY(index, list_index(words, lesions.size(), "lesion"));
    return lesions[index].id;
}

// X,Y,Z, or lesion:N@X,Y,Z: the nearest place to that of the lesion's surface.
Result<void> read_end(const Document& document, const LesionShapes& lesions, std::string_view word, Measurement& found,
                      std::size_t end) {
    std::string_view place = word;
    if (word.starts_with(kLesion)) {
        const std::size_t at = std::min(word.find('@'), word.size());
        RAMUS_TRY(lesion, lesion_in(document, word.substr(kLesion.size(), at - kLesion.size())));
        found.lesions[end] = lesion;
        place = word.substr(std::min(at + 1, word.size()));
    }
    const auto point = numbers_in(std::string(place), 3, kFarthestMm);
    if (!point)
        return fail("\"" + std::string(word) + "\" is not a point X,Y,Z in mm", {},
                    "of a lesion lesion:N@X,Y,Z, or lesion:N and branch:ID for the shortest distance");
    found.points[end] = {(*point)[0], (*point)[1], (*point)[2]};
    if (const auto shape = lesions.at(found.lesions[end]))
        found.points[end] = measure::nearest_on(*shape, found.points[end]);
    return {};
}

Result<Measurement> ends_in(const Document& document, const LesionShapes& lesions, Arguments words) {
    Measurement found;
    const auto whole = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with(kBranch); });
    if (whole == words.end()) {
        for (std::size_t i = 0; i < 2; ++i)
            if (auto good = read_end(document, lesions, words[i], found, i); !good) return tl::unexpected(good.error());
        return found;
    }
    const std::string& lesion = whole == words.begin() ? words[1] : words[0];
    if (!lesion.starts_with(kLesion) || lesion.find('@') != std::string::npos)
        return fail("the shortest distance to a branch is measured from a lesion", {}, "distance lesion:N branch:ID");
    RAMUS_TRY(from, lesion_in(document, std::string_view(lesion).substr(kLesion.size())));
    RAMUS_TRY(id, branch_id(document, whole->substr(kBranch.size())));
    found.shortest = true;
    found.lesions[0] = from;
    found.places[0].branch = id;
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

Result<Measurement> measurement_in(const Document& document, const LesionShapes& lesions, Arguments arguments) {
    const auto refused = fail("what is to be measured?", {}, kKinds);
    const auto* kind = arguments.empty() ? kKindNames.end()
                                         : std::ranges::find(kKindNames, std::string_view(arguments[0]),
                                                             &decltype(kKindNames)::value_type::first);
    if (kind == kKindNames.end()) return refused;
    const Arguments rest = arguments.subspan(1);
    switch (kind->second) {
    case Measurement::Kind::kDistance:
        if (rest.size() == 2) return ends_in(document, lesions, rest);
        return refused;
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

// Reads the meshes that arguments name, since a command reports its result only once.
LesionShapes shapes_for(ActionContext& context, Arguments arguments) {
    const Marks& marks = context.document.marks();
    Job job;
    if (std::ranges::any_of(arguments, [](const std::string& word) { return word.starts_with(kLesion); }))
        for (const Lesion& lesion : lesion_meshes(marks))
            if (!context.assets.lesion_mesh(lesion)) (void)load_lesion(context.assets, source_of(lesion), job);
    return lesion_shapes(context.assets, marks);
}

Result<void> measure_this(ActionContext& context, Arguments arguments) {
    if (!has_scene(context.document)) return fail("there is nothing to measure in", {}, "open a tree or a scan");
    const LesionShapes lesions = shapes_for(context, arguments);
    RAMUS_TRY(wanted, measurement_in(context.document, lesions, arguments));
    RAMUS_TRY(found, measured(*measured_tree(context.document), wanted, lesions));
    Marks next = context.document.marks();
    if (std::ranges::none_of(next.measurements, [&](const Measurement& m) { return measure_alike(m, wanted); }))
        next.measurements.push_back(wanted);
    if (auto few = check_counts(next); !few) return few;
    context.document.change(std::move(next));
    context.say(found.sentence());
    return {};
}

// The measurement keeps its kind and its place in the list.
Result<void> measure_change(ActionContext& context, Arguments arguments) {
    if (arguments.size() < 2)
        return fail("measure-change takes the number of a measurement and another one", {}, kKinds);
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().measurements.size(), "measurement"));
    const LesionShapes lesions = shapes_for(context, arguments);
    RAMUS_TRY(wanted, measurement_in(context.document, lesions, arguments.subspan(1)));
    RAMUS_TRY(found, measured(*measured_tree(context.document), wanted, lesions));
    context.say(found.sentence());
    return edit(context, [&, index = index](Marks& marks) {
        const Measurement before = std::exchange(marks.measurements[index], wanted);
        marks.measurements[index].id = before.id, marks.measurements[index].name = before.name;
    });
}

Result<void> measure_remove(ActionContext& context, Arguments arguments) {
    return remove_from(context, arguments, &Marks::measurements, "measurement");
}

Result<void> measure_clear(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.measurements.clear(); });
}

// The two highest ids of the selection, which has no other order.
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
                "Measures, tells and keeps: distance X,Y,Z X,Y,Z (straight; lesion:N@X,Y,Z is the nearest place of a "
                "lesion's "
                "surface); distance lesion:N branch:ID (the shortest from a lesion to a branch's wall); path ID "
                "FRACTION ID FRACTION (the "
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
