#include "app/actions/command_table.h"

#include "app/actions/groups.h"
#include "app/actions/phrases.h"
#include "app/assets/context_shapes.h"
#include "core/io/meshes/mesh_format.h"
#include "core/io/volumes/volume_format.h"

#include <algorithm>
#include <utility>

namespace ramus::app {

namespace {

std::vector<Command> make_table() {
    using namespace actions;
    std::vector<Command> table;
    for (auto part : {
             file_commands,      //
             history_commands,   //
             selection_commands, //
             relation_commands,  //
             lasso_commands,     //
             state_commands,     //
             glass_commands,     //
             surgery_commands,   //
             context_commands,   //
             measure_commands,   //
             report_commands,    //
             camera_commands,    //
             travel_commands,    //
             depth_commands,     //
             compare_commands,   //
             overview_commands,  //
             colour_commands,    //
             surface_commands,   //
             tool_commands,      //
             window_commands,    //
         })
        for (Command& command : part()) table.push_back(std::move(command));
    return table;
}

Result<void> run(ActionContext& context, const Command& command, Arguments arguments) {
    Document& document = context.document;
    document.begin_step();
    auto done = command.action(context, arguments);
    const MarksChange* change = document.last_change();
    document.end_step(change == nullptr ? "" : phrase_of(command, arguments, *change, document.marks()));
    return done;
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

std::string label_of(const Command& command, const Document& document) {
    return command.label_now == nullptr ? command.label : command.label_now(document);
}

Result<void> run_command(ActionContext& context, std::span<const std::string> words) {
    if (words.empty()) return {};
    const Command* command = find_command(words[0]);
    if (command == nullptr) return fail("there is no command \"" + words[0] + "\"", {}, "F1 in the window lists them");
    if (command->arguments.empty() && words.size() > 1) return fail(command->name + " takes no arguments");
    return run(context, *command, words.subspan(1));
}

Result<void> run_entry(ActionContext& context, const Command& command) {
    if (command.enabled != nullptr && !command.enabled(context.document)) return {};
    return run(context, command, command.preset);
}

Result<render::BranchPicture> Host::branch_picture() { return fail("what is visible is not known without a picture"); }
void Host::say(const std::string&) {}
Result<void> Host::open(const std::filesystem::path&) {
    return fail("a file cannot be opened from here", {}, "give it on the command line");
}
Result<void> Host::ask_for_file() { return fail("open needs a FILE here"); }
Result<void> Host::ask_for_lesion_mesh() {
    return fail("lesion-mesh needs a FILE here", {}, io::readable_mesh_extensions());
}
Result<void> Host::ask_for_context() { return fail("context needs a FILE here", {}, context_extensions()); }
Result<void> Host::ask_for_mask() {
    return fail("compare-mask needs a FILE here", {}, io::readable_volume_extensions());
}
Result<void> Host::ask_for_name() { return fail("save-as needs a window", {}, "save FILE"); }
Result<void> Host::copy_text(const std::string&) { return fail("there is no clipboard without a window"); }
Result<std::string> Host::pasted_text() { return fail("there is no clipboard without a window"); }
Result<void> Host::recover(int) { return fail("recover needs a window"); }
Result<void> Host::discard_recovery(int) { return fail("discard-recovery needs a window"); }
Result<void> Host::set_ui_scale(double) { return fail("ui-scale needs a window"); }
Result<void> Host::toggle(std::string_view part) {
    return fail("there is no " + std::string(part) + " without a window");
}
Result<render::Image> Host::draw_picture(const render::Camera&, glm::ivec2) { return fail("there is no picture here"); }
Result<void> Host::use_tool(std::string_view) { return fail("there is no tool without a window"); }
Result<void> Host::arrange(std::string_view part, std::string_view) { return toggle(part); }
Result<void> Host::quit() { return fail("quit needs a window"); }

} // namespace ramus::app
