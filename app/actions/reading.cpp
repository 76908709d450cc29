// Commands about reading the tree's file: its assumptions, repairs and suspicions, and rereading with other options.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/picture/fit.h"
#include "app/session/carry_over.h"
#include "app/session/mask_reading.h"
#include "app/session/numbers.h"
#include "app/session/reading_options.h"
#include "app/session/session_file.h"
#include "app/storage/opening_files.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

constexpr const char *kOrientationKey = "orientation", *kUnitsKey = "units";

constexpr const char* kReadAsUsage =
    "read-as units cm, radius-is diameter, orientation LPS, repair none, data FILE; of a mask labels together, "
    "fill-holes on, bulge-size 1, islands 10, root X,Y,Z; auto takes it back";

// The current options, changed by the arguments. `of_mask`: the file is a mask.
Result<io::ReadOptions> options_in(Arguments arguments, io::ReadOptions options, bool of_mask) {
    if (arguments.size() == 1 && arguments[0] == "usual") {
        io::ReadOptions usual;
        usual.columns = options.columns;
        return usual;
    }
    if (arguments.empty() || arguments.size() % 2 != 0)
        return fail("read-as takes an option and its value, or several such pairs", {}, kReadAsUsage);
    for (std::size_t i = 0; i < arguments.size(); i += 2) {
        if (is_mask_option(arguments[i]) && !of_mask)
            return fail(arguments[i] + " is an option of masks, and this tree is from a file of trees", {},
                        kReadAsUsage);
        auto next = with(std::move(options), arguments[i], arguments[i + 1]);
        if (!next) return next;
        options = std::move(*next);
    }
    return options;
}

Result<tree::VesselTree> read_again(const TreeFile& file, const io::ReadOptions& options, double memory_bytes,
                                    Job& job) {
    if (!file.checksum.empty()) {
        RAMUS_TRY(checksum, checksum_of(file.path));
        if (checksum != file.checksum)
            return fail("the file has changed since it was opened", file.path.string(), "open it again");
    }
    return read_tree_or_mask(file.path, options, memory_bytes, job);
}

Result<void> take_tree(ActionContext& context, const std::shared_ptr<const tree::VesselTree>& tree,
                       const io::ReadOptions& options) {
    Document& document = context.document;
    CarriedOver carried = carried_over(document.marks(), BranchMap::read_again(*document.tree(), *tree));
    carried.marks.reading = options;
    follow_unit(carried.marks, document.session().tree);
    document.change_tree(tree, std::move(carried.marks));
    const auto most = std::ranges::max_element(tree->points, {}, &tree::Point::radius);
    std::string sentence = "Read again: " + counted(tree->branches.size(), "branch", "branches") +
                           ", the thickest vessel is " + digits(2.0 * most->radius) + " mm wide";
    if (carried.lost > 0)
        sentence += "; " + counted(carried.lost, "mark", "marks") + " of branches that are no more went";
    context.say(sentence);
    return {};
}

Result<Outcome> read_as(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree to read again");
    const Session& session = context.document.session();
    RAMUS_TRY(options, options_in(arguments, session.marks.reading, io::is_volume(session.tree.path)));
    if (options == session.marks.reading) return Done{};
    if (!session.marks.edits.empty())
        return fail("the tree is edited, and edits are those of the tree as it was read", {},
                    "undo the edits, read the file in another way, and edit again");
    return Pending{"Reading " + session.tree.path.filename().string() + " again",
                   [file = session.tree, options, memory = static_cast<double>(session.marks.options.memory_bytes)](
                       Job& job) -> Result<Continuation> {
                       RAMUS_TRY(tree, read_again(file, options, memory, job));
                       const auto shared = std::make_shared<const tree::VesselTree>(std::move(tree));
                       return [shared, options](ActionContext& then) { return take_tree(then, shared, options); };
                   }};
}

// Without arguments opens the panel; otherwise short for read-as.
template <const char* const& kKey> Result<Outcome> say_or_ask(ActionContext& context, Arguments arguments) {
    if (arguments.empty()) {
        if (context.window == nullptr)
            return fail(std::string(kKey) + " takes a value without a window", {}, kReadAsUsage);
        return outcome_of(toggle_part(context, "orientation"));
    }
    if (arguments.size() != 1) return fail(std::string(kKey) + " takes one value", {}, kReadAsUsage);
    if (!has_tree(context.document)) {
        if (kKey == kUnitsKey) return read_context_in(context, arguments[0]);
        return fail("the axes of masks and meshes are those of their files", {}, "correct them in the files");
    }
    const std::vector<std::string> words{kKey, arguments[0]};
    return read_as(context, words);
}

// Short for read-as.
Result<Outcome> data(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kData,
                                       fail("data needs a FILE here", {}, "a table (CSV) of numbers of branches")));
    if (arguments.size() != 1)
        return fail("data takes one file", {}, "a table (CSV) of further numbers of branches, or auto for none");
    const std::vector<std::string> words{"data", arguments[0]};
    return read_as(context, words);
}

Result<void> doctor(ActionContext& context, Arguments) { return toggle_part(context, "doctor"); }

// The radius of the point nearest to `at`.
double radius_near(const tree::VesselTree& tree, const glm::dvec3& at) {
    const auto nearest = std::ranges::min_element(tree.points, {}, [&](const tree::Point& point) {
        const glm::dvec3 way = point.position - at;
        return glm::dot(way, way);
    });
    return nearest->radius;
}

Result<void> note(ActionContext& context, Arguments arguments) {
    const auto& tree = context.document.tree();
    if (!tree) return fail("there is no tree");
    RAMUS_TRY(index, list_index(arguments, tree->notes.size(), "note"));
    const tree::Note& chosen = tree->notes[index];
    if (!chosen.at) return fail("this note is about the whole tree, not about a place", {}, chosen.text);
    if (context.window != nullptr) context.window->show_note(static_cast<int>(index));
    return move_camera(context, looking_at(context.document.session().camera, *chosen.at,
                                           radius_near(*tree, *chosen.at), context.picture.picture_size()));
}

} // namespace

std::vector<Command> reading_commands() {
    return {
        Command("doctor", "",
                "Shows or hides the import doctor: what reading the file assumed, repaired and finds strange.", doctor)
            .in_menu("View", "Import doctor", {"Shift+D"})
            .in_submenu("Panels")
            .when(has_tree)
            .in_use_when(shows_part("doctor")),
        Command("note", "N", "Goes to the place of the N-th note of the import doctor, as the panel lists them.", note)
            .when(has_tree),
        Command(
            "orientation", "[XYZ|auto]",
            "Says which sides of the patient the file's axes lead to, as RAS or LPS; without them, asks for what the "
            "file does not say.",
            say_or_ask<kOrientationKey>)
            .in_menu("View", "Orientation and unit\xE2\x80\xA6")
            .when(has_scene)
            .in_use_when(shows_part("orientation")),
        Command("units", "[UNIT|auto]",
                "Says what one unit of the file's numbers is: mm, um, cm, m, or the size of a voxel in mm; without it, "
                "asks for what the file does not say. Without a tree, of all that is shown.",
                say_or_ask<kUnitsKey>)
            .when(has_scene),
        Command(
            "data", "[FILE|auto]",
            "Joins a table (CSV) of further numbers of branches to the tree, by the ids of its column branch or its "
            "first; auto takes it away; without a word, asks for one.",
            data)
            .in_menu("File", "Add data of branches...")
            .when(has_tree),
        Command(
            "read-as", "OPTION VALUE...|usual",
            "Reads the file again: units UNIT, radius-is radius|diameter, orientation XYZ, repair LIST, data FILE; of "
            "a "
            "mask "
            "channel N, time N, labels apart|together|N[+M...],..., isovalue X, fill-holes on|off, bulge-size X, "
            "islands MM, root X,Y,Z; "
            "auto leaves it to the file.",
            read_as)
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
