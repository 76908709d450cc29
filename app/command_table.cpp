#include "app/command_table.h"

#include "app/actions.h"

#include <algorithm>

namespace ramus::app {

namespace {

bool has_tree(const Document& document) { return document.branch_count() > 0; }
bool has_selection(const Document& document) { return !document.marks().selection.empty(); }
bool has_states(const Document& document) { return !document.marks().states.empty(); }
bool can_undo(const Document& document) { return document.can_undo(); }
bool can_redo(const Document& document) { return document.can_redo(); }
bool is_orthographic(const Document& document) { return document.session().camera.orthographic; }
template <ColourBy quantity> bool colours_by(const Document& document) {
    return document.marks().colour_by == quantity;
}

std::vector<Command> make_table() {
    using namespace actions;
    return {
        // File
        {"open",
         "[FILE]",
         "Opens a tree or a session; without FILE, asks for one.",
         "File",
         "Open...",
         {"Ctrl+O"},
         open},
        {"save",
         "[FILE]",
         "Writes the session: what is selected, hidden and highlighted, the camera, the options.",
         "File",
         "Save session",
         {"Ctrl+S"},
         save,
         {},
         has_tree},
        {"shot", "[FILE]", "Writes the picture as PNG.", "File", "Save picture", {"F12"}, shot, {}, has_tree},
        {"quit", "", "Closes ramus.", "File", "Quit", {"Ctrl+Q"}, quit},
        // Edit
        {"undo", "", "Takes the last change back.", "Edit", "Undo", {"Ctrl+Z"}, undo, {}, can_undo},
        {"redo",
         "",
         "Makes the change that was taken back again.",
         "Edit",
         "Redo",
         {"Ctrl+Shift+Z", "Ctrl+Y"},
         redo,
         {},
         can_redo},
        // Select
        {"select", "ID...", "Selects these branches and no others.", "", "", {}, select},
        {"select-add", "ID...", "Adds these branches to the selection.", "", "", {}, select_add},
        {"select-dependents",
         "",
         "Selects also all that depends on the selected branches.",
         "Select",
         "Dependents",
         {"D"},
         select_dependents,
         {},
         has_selection},
        {"select-upstream",
         "",
         "Selects also the way from the selected branches to the root.",
         "Select",
         "Upstream",
         {"U"},
         select_upstream,
         {},
         has_selection},
        {"select-invert",
         "",
         "Selects what is not selected, and nothing else.",
         "Select",
         "Invert",
         {"Ctrl+I"},
         select_invert,
         {},
         has_tree},
        {"select-subtree",
         "ID...",
         "Selects these branches and all that depends on them, and no others.",
         "",
         "",
         {},
         select_subtree},
        {"select-toggle",
         "ID...",
         "Takes each of these branches into the selection, or out of it.",
         "",
         "",
         {},
         select_toggle},
        {"select-none", "", "Selects nothing.", "Select", "Nothing", {}, select_none, {}, has_selection},
        {"dismiss", "", "Closes what lies on top; with nothing there, selects nothing.", "", "", {"Escape"}, dismiss},
        // Branches
        {"highlight",
         "",
         "Highlights the selected branches.",
         "Branches",
         "Highlight",
         {"H"},
         highlight,
         {},
         has_selection},
        {"defocus",
         "",
         "Makes the selected branches grey glass.",
         "Branches",
         "Defocus",
         {"G"},
         defocus,
         {},
         has_selection},
        {"defocus-others",
         "",
         "Makes everything but the selected branches grey glass.",
         "Branches",
         "Defocus others",
         {"Shift+G"},
         defocus_others,
         {},
         has_selection},
        {"hide", "", "Hides the selected branches.", "Branches", "Hide", {"X", "Delete"}, hide, {}, has_selection},
        {"show",
         "",
         "Makes the selected branches normal again.",
         "Branches",
         "Show normally",
         {"N"},
         show,
         {},
         has_selection},
        {"show-all",
         "",
         "Makes every branch normal again.",
         "Branches",
         "Show all",
         {"Shift+N"},
         show_all,
         {},
         has_states},
        {"name", "ID TEXT", "Gives a branch a name; an empty one takes it away.", "", "", {}, name},
        // View
        {"view",
         "NAME",
         "Looks from anterior, posterior, left, right, superior or inferior at the whole tree.",
         "",
         "",
         {},
         view},
        {"view",
         "NAME",
         "The viewer stands in front of the patient.",
         "View",
         "Anterior",
         {"A"},
         view,
         {"anterior"},
         has_tree},
        {"view",
         "NAME",
         "The viewer stands behind the patient.",
         "View",
         "Posterior",
         {"P"},
         view,
         {"posterior"},
         has_tree},
        {"view", "NAME", "The viewer stands at the patient's left.", "View", "Left", {"L"}, view, {"left"}, has_tree},
        {"view",
         "NAME",
         "The viewer stands at the patient's right.",
         "View",
         "Right",
         {"R"},
         view,
         {"right"},
         has_tree},
        {"view",
         "NAME",
         "The viewer looks down from the head.",
         "View",
         "Superior",
         {"S"},
         view,
         {"superior"},
         has_tree},
        {"view", "NAME", "The viewer looks up from the feet.", "View", "Inferior", {"I"}, view, {"inferior"}, has_tree},
        {"fit",
         "",
         "Brings the whole tree into the picture, from where the viewer stands.",
         "View",
         "Fit",
         {"F", "0"},
         fit,
         {},
         has_tree},
        {"orthographic",
         "[on|off]",
         "Switches between parallel and central projection.",
         "View",
         "Orthographic",
         {"O"},
         orthographic,
         {},
         has_tree,
         is_orthographic},
        {"colour-by",
         "QUANTITY",
         "Colours branches by nothing, generation, strahler, diameter or branch.",
         "",
         "",
         {},
         colour_by},
        {"colour-by",
         "QUANTITY",
         "One colour for the whole tree.",
         "Colour",
         "One colour",
         {},
         colour_by,
         {"nothing"},
         has_tree,
         colours_by<ColourBy::kNothing>},
        {"colour-by",
         "QUANTITY",
         "Colours by the number of branchings from the root.",
         "Colour",
         "Generation",
         {},
         colour_by,
         {"generation"},
         has_tree,
         colours_by<ColourBy::kGeneration>},
        {"colour-by",
         "QUANTITY",
         "Colours by Strahler order: 1 at the leaves.",
         "Colour",
         "Strahler order",
         {},
         colour_by,
         {"strahler"},
         has_tree,
         colours_by<ColourBy::kStrahler>},
        {"colour-by",
         "QUANTITY",
         "Colours by mean diameter.",
         "Colour",
         "Diameter",
         {},
         colour_by,
         {"diameter"},
         has_tree,
         colours_by<ColourBy::kDiameter>},
        {"colour-by",
         "QUANTITY",
         "Tells neighbouring branches apart.",
         "Colour",
         "Branch",
         {},
         colour_by,
         {"branch"},
         has_tree,
         colours_by<ColourBy::kBranch>},
        {"panel", "", "Shows or hides the side panel.", "View", "Side panel", {"Tab"}, panel},
        {"surface",
         "NAME VALUE",
         "Sets smooth, prune, width, detail or method (cs, cones) of the surface.",
         "",
         "",
         {},
         surface},
        {"help", "", "Shows what the mouse and the keys do.", "Help", "Mouse and keys", {"F1", "?"}, help},
    };
}

} // namespace

const std::vector<Command>& command_table() {
    static const std::vector<Command> table = make_table();
    return table;
}

const Command* find_command(std::string_view name) {
    const auto& table = command_table();
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == name && c.scripted(); });
    return found == table.end() ? nullptr : &*found;
}

const Command* command_for_key(std::string_view key) {
    for (const Command& command : command_table())
        if (std::find(command.keys.begin(), command.keys.end(), key) != command.keys.end()) return &command;
    return nullptr;
}

Result<void> run_command(ActionContext& context, std::span<const std::string> words) {
    if (words.empty()) return {};
    const Command* command = find_command(words[0]);
    if (command == nullptr) return fail("there is no command \"" + words[0] + "\"", {}, "F1 in the window lists them");
    if (command->arguments.empty() && words.size() > 1) return fail(command->name + " takes no arguments");
    return command->action(context, words.subspan(1));
}

Result<void> run_entry(ActionContext& context, const Command& command) {
    if (command.enabled != nullptr && !command.enabled(context.document)) return {};
    return command.action(context, command.preset);
}

std::filesystem::path Host::suggested_file(std::string_view extension) const {
    return "ramus" + std::string(extension);
}
void Host::say(const std::string&) {}
Result<void> Host::open(const std::filesystem::path&) {
    return fail("a file cannot be opened from here", {}, "give it on the command line");
}
Result<void> Host::ask_for_file() { return fail("open needs a FILE here"); }
Result<void> Host::toggle(std::string_view part) {
    return fail("there is no " + std::string(part) + " without a window");
}
Result<void> Host::quit() { return fail("quit needs a window"); }

} // namespace ramus::app
