#include "app/commands/suggestions.h"

#include "core/base/closest_word.h"
#include "core/io/file_format.h"

#include <algorithm>
#include <vector>

namespace ramus::app {

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::string command_line(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app.get_name() : app.get_name() + " " + chosen.front()->get_name();
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// The subcommands that have an option: "mesh, render or study".
std::string commands_with(const CLI::App& app, const std::string& option) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (command->get_option_no_throw(option) != nullptr) names.push_back(command->get_name());
    return io::listed({names.begin(), names.end()});
}

// A suggestion for an unknown option, as one line; empty: no option is similar.
std::string meant_by(const CLI::App& app, const CLI::App& command, const std::string& argument) {
    const std::string option = argument.substr(0, argument.find('='));
    if (const std::string closest = closest_word(option, option_names(command)); !closest.empty())
        return "Did you mean " + closest + "?\n";
    const std::string others = commands_with(app, option);
    return others.empty() ? "" : option + " is an option of ramus " + others + ".\n";
}

} // namespace

bool is_command(const CLI::App& app, const std::string& word) {
    return std::ranges::count(command_names(app), word) > 0;
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
    const std::string closest = closest_word(word, command_names(app));
    return word + ": neither a command nor a file; " +
           (closest.empty() ? "ramus --help lists the commands" : "did you mean " + closest + "?");
}

std::string failure_text(const CLI::App* app, const CLI::Error& error) {
    const auto commands = app->get_subcommands();
    const CLI::App& chosen = commands.empty() ? *app : *commands.front();
    std::string text = std::string(error.what()) + "\n";
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError))
        for (const std::string& argument : app->remaining(true))
            if (argument.starts_with("--")) text += meant_by(*app, chosen, argument);
    return text + "Run " + command_line(*app) + " --help for more information.\n";
}

} // namespace ramus::app
