// Commands of the organ that an operation is planned in: its mask, its territories, the patient's size.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/sort_unique.h"
#include "core/base/words.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

constexpr double kMostPatient = 1e4; // kg and cm

bool has_organ(const Document& document) { return document.marks().organ.any(); }

Result<void> expect_organ(const Document& document) {
    if (!has_organ(document)) return fail("there is no organ", {}, "organ FILE reads its mask");
    return {};
}

Result<void> take_organ(ActionContext& context, const OrganSource& source, const Loaded<OrganMask>& mask) {
    if (context.assets.organ.source != source) context.assets.organ = {source, mask};
    const OrganMask& organ = **mask.value;
    const Lengths lengths(organ.claims);
    std::string said = "Organ: " + lengths.volume(1000.0 * organ.organ.volume_ml());
    if (organ.parts.size() > 1)
        said += " in " + grouped(organ.parts.size()) + " parts that do not touch; the largest has " +
                digits(100.0 * static_cast<double>(organ.parts.front()) / static_cast<double>(organ.organ.count())) +
                " % of it";
    context.say(said + (organ.suspicion.empty() ? "" : "; " + organ.suspicion));
    auto done = edit(context, [&](Marks& marks) {
        marks.organ.source = source;
        if (marks.organ.territories == TerritoriesOf::kNothing) marks.organ.territories = TerritoriesOf::kOrgan;
    });
    // Who saw the whole tree sees the whole organ.
    const glm::ivec2 size = context.picture.picture_size();
    if (done && whole_in_picture(context, size))
        return move_camera(context, fitted_to_organ(context, organ.organ, size));
    return done;
}

Result<Outcome> organ(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kOrgan,
                                       fail("organ needs a FILE here", {}, io::readable_volume_extensions())));
    RAMUS_TRY(wanted, mask_argument("organ", arguments));
    return Pending{"Reading the organ", [source = wanted](Job& job) -> Result<Continuation> {
                       auto mask = read_organ(source, nullptr, job);
                       if (!mask.value) return tl::unexpected(mask.value.error());
                       return [source, mask](ActionContext& then) { return take_organ(then, source, mask); };
                   }};
}

// Changes the organ's marks by change(OrganChoice&).
template <class Change> Result<void> change_organ(ActionContext& context, const Change& change) {
    return edit(context, [&](Marks& marks) { change(marks.organ); });
}

Result<void> organ_clear(ActionContext& context, Arguments) {
    return change_organ(context, [](OrganChoice& choice) {
        choice.source = {};
        choice.territories = TerritoriesOf::kNothing;
    });
}

Result<void> organ_by(ActionContext& context, Arguments arguments) {
    const auto rule = arguments.size() == 1 ? organ::rule_named(arguments[0]) : std::nullopt;
    if (!rule) return fail("organ-by takes tips, axis or wall", {}, "tips is the default");
    return change_organ(context, [&](OrganChoice& choice) { choice.rule = *rule; });
}

Result<void> organ_role(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree");
    if (arguments.size() != 2 || (arguments[1] != "supplies" && arguments[1] != "drains"))
        return fail("organ-role takes a vessel system, and supplies or drains");
    const tree::VesselTree& tree = *context.document.tree();
    std::size_t system = 0;
    if (!tree.systems.empty()) {
        RAMUS_TRY(found, find_system(systems_of(tree, context.document.marks()), arguments[0]));
        system = static_cast<std::size_t>(found);
    }
    return edit(context, [&](Marks& marks) {
        marks.organ.roles = roles_of(tree, marks);
        marks.organ.roles[system] = arguments[1] == "drains" ? organ::Role::kDrains : organ::Role::kSupplies;
    });
}

Result<void> organ_large_vessels(ActionContext& context, Arguments arguments) {
    const auto limit = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!limit)
        return fail("organ-large-vessels takes a diameter in mm", {},
                    "vessels of at least that diameter are not part of the functional organ");
    return change_organ(context, [&](OrganChoice& choice) { choice.large_vessels_mm = *limit; });
}

Result<void> organ_patient(ActionContext& context, Arguments arguments) {
    std::array<double, 2> numbers{};
    bool good = arguments.size() <= numbers.size();
    for (std::size_t i = 0; good && i < arguments.size(); ++i) {
        const auto number = number_in(arguments[i], 0.0, kMostPatient);
        good = number.has_value();
        numbers[i] = number.value_or(0.0);
    }
    if (!good) return fail("organ-patient takes the patient's weight in kg and height in cm", {}, "0: it is not known");
    return change_organ(context, [&](OrganChoice& choice) {
        choice.weight_kg = numbers[0];
        choice.height_cm = numbers[1];
    });
}

Result<void> organ_limits(ActionContext& context, Arguments arguments) {
    const auto weight = arguments.size() == 2 ? number_in(arguments[0], 0.0, 100.0) : std::nullopt;
    const auto standard = arguments.size() == 2 ? number_in(arguments[1], 0.0, 100.0) : std::nullopt;
    if (!weight || !standard)
        return fail("organ-limits takes two numbers: the least remnant in percent of the body's weight, and of the "
                    "standard liver volume",
                    {}, "0.5 30 is the default");
    return change_organ(context, [&](OrganChoice& choice) {
        choice.least_of_weight = *weight;
        choice.least_of_standard = *standard;
    });
}

Result<void> territories(ActionContext& context, Arguments arguments) {
    const auto of = arguments.empty() ? std::nullopt : territories_named(arguments[0]);
    if (!of)
        return fail("territories takes what they belong to: " +
                        joined(kTerritoriesOf, ", ", [](const auto& row) { return std::string(row.second); }),
                    {}, "generation can be followed by its number, and each by --system and a vessel system");
    if (auto organ = expect_organ(context.document); !organ) return organ;
    OrganChoice next = context.document.marks().organ;
    next.territories = *of;
    arguments = arguments.subspan(1);
    if (*of == TerritoriesOf::kGeneration && !arguments.empty() && arguments[0] != "--system") {
        const auto generation = parsed<int>(arguments[0]);
        if (!generation || *generation < 0) return fail("a generation is a number from 0", {}, "0: the roots");
        next.generation = *generation;
        arguments = arguments.subspan(1);
    }
    if (arguments.size() == 2 && arguments[0] == "--system" && has_tree(context.document)) {
        RAMUS_TRY(system, find_system(systems_of(*context.document.tree(), context.document.marks()), arguments[1]));
        next.system = system;
    } else if (!arguments.empty()) {
        return fail("territories takes one kind, the number of a generation, and --system with a vessel system");
    }
    return change_organ(context, [&](OrganChoice& choice) { choice = next; });
}

Result<void> territories_opacity(ActionContext& context, Arguments arguments) {
    const auto opacity = arguments.size() == 1 ? number_in(arguments[0], 0.0, 1.0) : std::nullopt;
    if (!opacity) return fail("territories-opacity takes a number from 0 to 1, which is solid");
    return change_organ(context, [&](OrganChoice& choice) { choice.opacity = *opacity; });
}

Result<void> territories_apart(ActionContext& context, Arguments arguments) {
    const auto apart = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!apart) return fail("territories-apart takes a distance in mm", {}, "0: everything is where it is");
    return change_organ(context, [&](OrganChoice& choice) { choice.apart_mm = *apart; });
}

Result<void> switch_territory(ActionContext& context, Arguments arguments, bool hide) {
    if (arguments.size() != 1) return fail("which territory?", {}, "its name, in quotes if it has blanks");
    return change_organ(context, [&](OrganChoice& choice) {
        std::erase(choice.hidden, arguments[0]);
        if (hide) choice.hidden.push_back(arguments[0]);
        sort_unique(choice.hidden);
    });
}
Result<void> territory_hide(ActionContext& context, Arguments arguments) {
    return switch_territory(context, arguments, true);
}
Result<void> territory_show(ActionContext& context, Arguments arguments) {
    return switch_territory(context, arguments, false);
}

Command territories_in_menu(const char* help, const char* item, std::vector<std::string> words) {
    return Command("territories", "off|organ|systems|generation [N]|names|selection|cuts|remnant [--system SYSTEM]",
                   help, territories)
        .in_menu("Plan", item)
        .giving(std::move(words))
        .when(has_organ);
}

} // namespace

std::vector<Command> organ_commands() {
    return {
        Command("organ", "[FILE [--label LABEL,...] [--units UNIT]]",
                "Reads the mask of the organ that is planned in, or the labels of a mask, and shows it; without FILE, "
                "asks for one. "
                "Its voxels are divided among the branches that supply and drain them.",
                organ)
            .in_menu("Plan", "Organ\xE2\x80\xA6"),
        Command("organ-clear", "", "Takes the organ away.", organ_clear).when(has_organ),
        Command("organ-by", "tips|axis|wall",
                "Which branch a voxel belongs to: the nearest, where tips reach further and thick axes less far "
                "(default), the nearest axis, or the nearest wall.",
                organ_by),
        Command("organ-role", "SYSTEM supplies|drains",
                "Says what a vessel system does for the organ; veins but the portal vein drain it unless told.",
                organ_role)
            .when(has_tree),
        Command("organ-large-vessels", "MM",
                "Sets the diameter from which vessels are not part of the functional organ.", organ_large_vessels),
        Command("organ-patient", "[KG [CM]]",
                "Sets the patient's weight in kg and height in cm, to which the remnant is compared; 0 is unknown.",
                organ_patient),
        Command("organ-limits", "PERCENT PERCENT",
                "Sets the customary least remnant in percent of the body's weight and of the standard liver volume.",
                organ_limits),
        Command("territories", "off|organ|systems|generation [N]|names|selection|cuts|remnant [--system SYSTEM]",
                "Shows the parts of the organ that the branches of a kind supply or drain.", territories),
        territories_in_menu("Shows what the selected branches and all that depend on them supply.",
                            "Territory of the selected", {"selection"}),
        territories_in_menu("Shows the parts of the organ that the named branches supply.", "Territories of names",
                            {"names"}),
        territories_in_menu("Shows what each cut takes away from the organ.", "Territories of cuts", {"cuts"}),
        territories_in_menu("Shows no territories.", "No territories", {"off"}),
        Command("territories-opacity", "X", "How dense territories are, from 0 to 1, which is solid.",
                territories_opacity),
        Command("territories-apart", "MM", "Pulls the removed part of the organ away from what remains.",
                territories_apart),
        Command("territory-hide", "NAME", "Keeps the territory of this name, and does not show it.", territory_hide),
        Command("territory-show", "NAME", "Shows the territory of this name again.", territory_show),
    };
}

} // namespace ramus::app::actions
