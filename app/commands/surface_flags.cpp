#include "app/commands/surface_flags.h"

#include "app/commands/command.h"
#include "app/session/surface_options.h"

#include <algorithm>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

// CLI::Range would let NaN through.
CLI::Validator domain_of(const SurfaceOption& option) {
    return {[&option](std::string& text) -> std::string {
                double value = 0.0;
                if (!CLI::detail::lexical_cast(text, value) || !takes(option, value))
                    return text + " is not " + std::string(option.domain);
                return {};
            },
            ""};
}

std::string flag_of(std::string_view key) { return "--" + std::string(key); }

std::string repair_names() {
    std::string names;
    for (const auto& [repair, name] : tree::kRepairNames) names += (names.empty() ? "" : ",") + std::string(name);
    return names;
}

std::optional<tree::Repair> repairs_in(const std::string& list) {
    if (list == "all") return tree::Repair::kAll;
    if (list == "none") return tree::Repair::kNone;
    tree::Repair chosen = tree::Repair::kNone;
    for (const std::string& word : CLI::detail::split(list, ',')) {
        const auto* const known =
            std::ranges::find_if(tree::kRepairNames, [&](const auto& entry) { return word == entry.second; });
        if (known == std::end(tree::kRepairNames)) return std::nullopt;
        chosen = chosen | known->first;
    }
    return chosen;
}

} // namespace

void add_reading_flags(CLI::App& command, SurfaceFlags& flags) {
    command
        .add_option_function<std::string>(
            "--repair", [&flags](const std::string& list) { flags.read.repair = *repairs_in(list); },
            "What to mend in a damaged tree: all (default), none, or some of " + repair_names())
        ->type_name("LIST")
        ->check(CLI::Validator(
            [](std::string& list) -> std::string {
                return repairs_in(list) ? "" : list + " is not all, none, or a list of " + repair_names();
            },
            ""));
    command.add_flag("--verbose", flags.verbose, "Say on standard error what is going on");
}

mesh::SurfaceOptions SurfaceFlags::over(mesh::SurfaceOptions session) const {
    const auto given = [&](const std::string& name) {
        const CLI::Option* option = command->get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    if (given("--method")) session.method = surface.method;
    for (const SurfaceOption& option : surface_options()) {
        if (option.of_session && !given(flag_of(option.key))) continue; // else the machine's business
        option.set(session, option.value(surface));
        if (option.key == "detail") session.cell_mm = 0.0;
    }
    session.memory_bytes = surface.memory_bytes;
    return session;
}

void add_method_flag(CLI::App& command, bool with_masks, const std::function<void(mesh::Method)>& take) {
    std::vector<std::string> keys;
    for (const mesh::MethodRow& row : mesh::kMethods)
        if (row.of_tree || with_masks) keys.emplace_back(row.key);
    command
        .add_option_function<std::string>(
            "--method", [take](const std::string& key) { take(*mesh::method_named(key)); },
            mesh::method_help(with_masks))
        ->type_name("METHOD")
        ->check(CLI::IsMember(keys));
}

void add_surface_flags(CLI::App& command, SurfaceFlags& flags) {
    flags.command = &command;
    mesh::SurfaceOptions& surface = flags.surface;
    for (const SurfaceOption& option : surface_options()) {
        CLI::Option* flag =
            command
                .add_option_function<double>(
                    flag_of(option.key), [&surface, &option](double value) { option.set(surface, value); },
                    std::string(option.help))
                ->type_name(std::string(option.unit))
                ->check(domain_of(option));
        if (!option.instead.empty()) flag->excludes(command.get_option(flag_of(option.instead)));
    }
    add_option(command, "--memory", "SIZE", surface.memory_bytes,
               "Most memory to use, as 800M or 4G (default 0: half of the machine's); ramus mesh streams larger "
               "surfaces to the disk")
        ->transform(CLI::AsSizeValue(false));
    add_reading_flags(command, flags);
}

} // namespace ramus::app
