#include "app/actions/command_search.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

std::string first_for(std::string_view words) {
    const auto found = search_commands(words);
    if (found.empty()) return "";
    const Command& best = *found.front();
    return best.name + (best.preset.empty() ? "" : " " + best.preset.front());
}

} // namespace

TEST_CASE("commands are found by everyday words") {
    CHECK(first_for("tumour") == "tool lesion");
    CHECK(first_for("print") == "export");
    CHECK(first_for("export") == "export");
    CHECK(first_for("screenshot") == "shot");
    CHECK(first_for("hide") == "hide");
    CHECK(first_for("downstream") == "select-dependents");
    CHECK(first_for("perspective") == "orthographic");
    CHECK(first_for("ruler") == "tool measure-distance");
    CHECK(first_for("rename") == "rename");
    CHECK(first_for("undo") == "undo");
    CHECK(first_for("Left") == "view left");
    for (const char* typed : {"Side panel", "side panel", "Side pan", "panel", "View side panel"})
        CHECK_MESSAGE(first_for(typed) == "panel", typed);
    CHECK(first_for("Explore or plan") == "panel other");
    CHECK(first_for("fly") == "fly"); // a command of that name
    CHECK(first_for("fly along") == "fly-along");
}

// S. Oeltze and B. Preim, "Visualization of Vasculature with Convolution Surfaces", 2005.
TEST_CASE("commands are found by the words of the paper") {
    const auto lists = [](std::string_view words, std::string_view name) {
        return std::ranges::any_of(search_commands(words), [&](const Command* found) { return found->name == name; });
    };
    for (const char* words : {"width coefficient", "isovalue", "convolution surface", "binomial filter", "smoothing",
                              "pruning", "bounding volume", "bulging"})
        CHECK_MESSAGE(first_for(words) == "surface", words);
    for (const char* words : {"truncated cones", "isosurface"}) // not "compare off", which shows one surface
        CHECK_MESSAGE(first_for(words) == "compare side-by-side", words);
    CHECK(lists("truncated cones", "surface"));
    CHECK(lists("truncated cones", "deviation-from"));
    for (const char* words : {"skeleton", "centerline"}) CHECK_MESSAGE(first_for(words) == "skeleton", words);
    CHECK(first_for("unwanted blending") == "blend");
    CHECK(lists("unwanted blending", "contacts"));
    CHECK(first_for("VoxDiag2") == "deviation-scale");
    CHECK(first_for("deviation") == "colour-by deviation");
    CHECK(first_for("distance") == "tool measure-distance");
    CHECK(lists("distance", "colour-by"));
    CHECK(first_for("validation") == "validation");
    CHECK(first_for("transparency") == "defocus");
    CHECK(lists("transparency", "glass-opacity"));
    CHECK(lists("transparency", "context-opacity"));
    CHECK(first_for("territory") == "territories selection");
}

TEST_CASE("an exact name or menu entry is the first result") {
    for (const Command* command : search_commands("")) {
        CAPTURE(command->name);
        std::string entry = command->name;
        for (const std::string& given : command->preset) entry += " " + given;
        CAPTURE(entry);
        const auto by_entry = search_commands(entry);
        REQUIRE_FALSE(by_entry.empty());
        CHECK(by_entry.front()->name == command->name);
        CHECK(by_entry.front()->preset == command->preset);
        const auto by_name = search_commands(command->name); // which may stand for several
        REQUIRE_FALSE(by_name.empty());
        CHECK(by_name.front()->name == command->name);
        if (command->menu.empty()) continue;
        const auto by_title = search_commands(command->menu + " \xE2\x80\xBA " + command->label);
        REQUIRE_FALSE(by_title.empty());
        CHECK(by_title.front()->label == command->label);
        CHECK(by_title.front()->menu == command->menu);
    }
    CHECK(first_for("lesion") == "lesion");
    CHECK(first_for("Lesion") == "tool lesion");
}

TEST_CASE("help texts of commands do not mention options of the command line") {
    for (const Command* command : search_commands(""))
        CHECK_MESSAGE(command->help.find("--") == std::string::npos, command->name);
}

TEST_CASE("all words must match, in any order, and a misspelled word matches the most similar one") {
    CHECK(first_for("all show") == "show-all");
    CHECK(first_for("clear lesion") == "lesion-clear");
    CHECK(first_for("tumuor") == "tool lesion");
    CHECK(first_for("meassure angle") == "tool measure-angle");
    CHECK(search_commands("hide xyzzyq").empty());
}

TEST_CASE("without words, all commands are listed once, except those that only the window uses") {
    const auto all = search_commands("");
    const std::set<const Command*> once(all.begin(), all.end());
    CHECK(once.size() == all.size());
    std::set<std::string> names;
    for (const Command* command : all) names.insert(command->name);
    for (const Command& command : command_table())
        CHECK_MESSAGE(names.contains(command.name) == (command.name != "dismiss" && command.name != "palette"),
                      command.name);
    CHECK(std::ranges::equal(search_commands("  ,;"), all));
}

TEST_CASE("a command that is typed with arguments is recognised by its name") {
    const Command* command = command_given_by("select 3");
    REQUIRE(command != nullptr);
    CHECK(command->name == "select");
    CHECK(command_given_by("select 1") == command); // "1" begins a word of an entry
    CHECK(command_given_by("hide vessels") == nullptr);
    // A word that its argument may be is no word to search by: "panel surface" found the entry "Side panel".
    CHECK(command_given_by("panel surface") == find_command("panel"));
    CHECK(command_given_by("theme light") == find_command("theme"));
    CHECK(command_given_by("ui-scale auto") == find_command("ui-scale"));
    // Files, lists of numbers and names with a hyphen are typed as in a script, whatever words are found in them.
    for (const char* typed : {"save /data/case.ramus.json", "hide-system portal", "colour-by file:flow.mean",
                              "compare side-by-side cs,iso"})
        CHECK_MESSAGE(command_given_by(typed) != nullptr, typed);
    for (const char* entry : {"view left", "ui-scale larger", "background white", "Side panel"})
        CHECK_MESSAGE(command_given_by(entry) == nullptr, entry);
    for (const char* none : {"", "select", "select  ", "no-command 3", "show-all 3", " select 3"})
        CHECK(command_given_by(none) == nullptr);
}

TEST_CASE("a command is marked as needing arguments if it cannot run without them") {
    CHECK(needs_arguments(*find_command("select-diameter")));
    CHECK_FALSE(needs_arguments(*find_command("fit")));
    CHECK_FALSE(needs_arguments(*find_command("orthographic"))); // [on|off]
    for (const Command* command : search_commands(""))
        if (!command->preset.empty()) CHECK_FALSE(needs_arguments(*command));
}
