#include "app/commands/cohort_options.h"

#include "app/commands/command.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using Json = nlohmann::ordered_json;

struct StepCommand {
    const char* step;
    const char* command;
};
constexpr std::array<StepCommand, 4> kStepCommands{
    {{"skeletonize", "skeletonize"}, {"measure", "info"}, {"validate", "validate"}, {"picture", "render"}}};

// The names of all options of a command.
std::set<std::string> names_of_options(const CLI::App& command) {
    std::set<std::string> names;
    for (const CLI::Option* option : command.get_options()) names.insert(option->get_name());
    return names;
}

std::set<std::string> source_options() {
    CLI::App scratch;
    SurfaceFlags flags;
    add_source_flags(scratch, flags);
    return names_of_options(scratch);
}

// Whether the command takes the option by itself. Options that need another one (--width of info) are not for it.
bool takes_option(const CLI::App& command, const std::string& name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option != nullptr && option->get_needs().empty();
}

void append_words(Json& words, const std::string& name, const Json& values) {
    if (values.empty()) words.push_back(name);
    for (const Json& value : values) words.push_back(name + "=" + value.get<std::string>());
}

// "1+3,2" is what --label takes as "1,3,2". Empty: all labels.
std::string given_labels(const Json& given) {
    if (!given.contains("--labels")) return {};
    std::string labels = given.at("--labels").at(0);
    if (labels == "apart" || labels == "together" || labels == "all") return {};
    std::ranges::replace(labels, '+', ',');
    return labels;
}

} // namespace

void add_cohort_surface_flags(CLI::App& command, SurfaceFlags& flags) {
    add_surface_flags(command, flags);
    for (const char* other : {"--root", "--data", "--verbose", "--threads"})
        command.remove_option(command.get_option(other));
    add_option(command, "--threads", "N", flags.surface.threads,
               "Threads of each step (default 1: cases run side by side instead)")
        ->check(CLI::Range(1, 4096));
}

bool compares_masks(const Json& given) { return !given.contains("--isovalue"); }

Json given_options(const CLI::App& command, const SurfaceFlags& flags) {
    CLI::App scratch;
    SurfaceFlags unused;
    add_surface_flags(scratch, unused);
    const std::set<std::string> known = names_of_options(scratch);
    Json given = Json::object();
    for (const CLI::Option* option : command.get_options()) {
        const std::string& name = option->get_name();
        // How much of the machine a step may use does not change its result.
        if (option->count() == 0 || !known.contains(name) || name == "--threads" || name == "--memory") continue;
        Json values = Json::array();
        if (name == "--radius-is") // the parser has replaced the word by a number
            values.push_back(flags.read.radius_is == io::RadiusIs::kDiameter ? "diameter" : "radius");
        else if (option->get_items_expected_max() > 0)
            for (const std::string& value : option->results()) values.push_back(value);
        given[name] = std::move(values);
    }
    return given;
}

Json step_options(CLI::App& app, const Json& given) {
    const std::set<std::string> reading = source_options();
    Json options;
    for (const bool mask : {false, true}) {
        Json& steps = options[mask ? "mask" : "tree"];
        for (const StepCommand& one : kStepCommands) {
            const CLI::App& command = *app.get_subcommand(one.command);
            const bool reads_source = !mask || std::string_view(one.step) == "skeletonize";
            Json& words = steps[one.step] = Json::array();
            for (const auto& [name, values] : given.items())
                if (takes_option(command, name) && (reads_source || !reading.contains(name)))
                    append_words(words, name, values);
        }
    }
    if (!compares_masks(given)) return options;
    Json& compared = options["mask"]["validate"];
    if (const std::string labels = given_labels(given); !labels.empty()) compared.push_back("--label=" + labels);
    if (given.contains("--units")) compared.push_back("--mask-units=" + given.at("--units").at(0).get<std::string>());
    return options;
}

} // namespace ramus::app
