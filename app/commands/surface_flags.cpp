#include "app/commands/surface_flags.h"

#include "app/commands/command.h"
#include "app/session/mask_reading.h"
#include "app/session/reading_options.h"
#include "app/session/surface_options.h"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

// A check of an option's domain. CLI::Range would accept NaN.
auto domain_of(const SurfaceOption& option) {
    return expecting(" is not " + std::string(option.domain), [&option](const std::string& text) {
        double value = 0.0;
        return CLI::detail::lexical_cast(text, value) && takes(option, value);
    });
}

std::string flag_of(std::string_view key) { return "--" + std::string(key); }

auto unit_check() { return expecting(" is not mm, um, cm, m, or a size of voxels in mm, as 0.62", io::length_unit); }

// Adds the options that state what the numbers of a file mean, for files that do not say it or are wrong.
void add_meaning_flags(CLI::App& command, io::ReadOptions& read) {
    add_units_flag(command, read);
    const std::map<std::string, io::RadiusIs> widths = {{"radius", io::RadiusIs::kRadius},
                                                        {"diameter", io::RadiusIs::kDiameter}};
    command.add_option("--radius-is", read.radius_is, "What a tree's file has for a width: radius or diameter")
        ->type_name("WIDTH")
        ->transform(CLI::CheckedTransformer(widths).description(""));
    add_option_taking<std::string>(
        command, "--radius", "MM",
        [&read](const std::string& text) { read.radius_mm = with(io::ReadOptions(), "radius", text)->radius_mm; },
        "Radius of all points of a tree whose file gives none, in mm")
        ->check(expecting(" is not a number of mm above 0", [](const std::string& text) {
            return text != "auto" && with(io::ReadOptions(), "radius", text).has_value();
        }));
    add_option_taking<std::string>(
        command, "--orientation", "XYZ",
        [&read](const std::string& text) { read.orientation = io::Orientation::named(text); },
        "Which sides of the patient a tree's axes x, y and z lead to, three letters of R L A P S I, as RAS or LPS")
        ->check(
            expecting(" does not name a side for each of three axes, as RAS, LPS or PIR do", io::Orientation::named));
    add_option_taking<std::vector<std::string>>(
        command, "--columns", "WHAT=NAME,...",
        [&read](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) {
                const std::size_t equals = pair.find('=');
                read.columns[pair.substr(0, equals)] = pair.substr(equals + 1);
            }
        },
        "Columns of a table to read: x, y, z, radius, id, from, to = NAME")
        ->delimiter(',')
        ->check(expecting(" is not WHAT=NAME with x, y, z, radius, id, from or to", [](const std::string& pair) {
            const std::set<std::string> known = {"x", "y", "z", "radius", "id", "from", "to"};
            const std::size_t equals = pair.find('=');
            return equals != std::string::npos && known.contains(pair.substr(0, equals));
        }));
}

} // namespace

void add_units_flag(CLI::App& command, io::ReadOptions& read) {
    add_option_taking<std::string>(
        command, "--units", "UNIT", [&read](const std::string& text) { read.unit = io::length_unit(text); },
        "Unit of a tree's or a volume's lengths: mm, um, cm, m, or the size of a voxel in mm, as 0.62 or "
        "0.3x0.3x0.6")
        ->check(unit_check());
    const auto add_part = [&](const std::string& name, std::optional<int>& number, const std::string& noun) {
        add_option_taking<int>(
            command, name, "N", [&number](int chosen) { number = chosen; },
            "Of a volume whose file holds several " + noun + "s: the one to read, from 1")
            ->check(CLI::Range(1, 1'000'000'000).description(""));
    };
    add_part("--channel", read.part.channel, "channel");
    add_part("--time", read.part.time, "time point");
}

CLI::Option* add_mask_units_flag(CLI::App& command, std::string& units, const std::string& masks) {
    return command.add_option("--mask-units", units, "Unit of the lengths in " + masks + ", as with --units")
        ->type_name("UNIT")
        ->check(unit_check());
}

CLI::Option* add_mesh_orientation_flag(CLI::App& command, std::string& axes, const std::string& meshes) {
    return add_option_taking<std::string>(
               command, "--mesh-orientation", "LPS|RAS",
               [&axes](const std::string& word) { axes = io::slicer_space(word)->letters(); },
               "Axes of " + meshes + " where the file does not state them (default RAS)")
        ->check(expecting(" is neither LPS nor RAS", io::slicer_space));
}

void add_axes_flag(CLI::App& command, std::optional<io::Orientation>& axes, const std::string& help) {
    add_option_taking<std::string>(
        command, "--axes", "LPS|RAS", [&axes](const std::string& word) { axes = io::slicer_space(word); }, help)
        ->check(expecting(" is neither LPS nor RAS", io::slicer_space));
}

void add_reading_flags(CLI::App& command, SurfaceFlags& flags) {
    add_option_taking<std::string>(
        command, "--repair", "LIST", [&flags](const std::string& list) { flags.read.repair = *repairs_in(list); },
        "What to repair in a damaged tree: usual (default, all that does not change measured radii), all, none, or "
        "some of " +
            repair_names())
        ->check(expecting(" is not usual, all, none, or a list of " + repair_names(), repairs_in));
    add_meaning_flags(command, flags.read);
    add_option_taking<std::string>(
        command, "--data", "FILE",
        [&flags](const std::string& file) {
            if (auto known = with(flags.read, "data", file)) flags.read = std::move(*known);
        },
        "Join this table (CSV) to the tree: ids of branches in its column branch or its first, further columns of "
        "numbers become data of the branches")
        ->check(expecting(" cannot be read as a table of data",
                          [](const std::string& file) { return with(io::ReadOptions(), "data", file).has_value(); }));
    command.add_flag("--verbose", flags.verbose, "Report each step on standard error");
}

void add_mask_reading_flags(CLI::App& command, io::MaskReading& mask) {
    add_option_taking<std::array<double, 3>>(
        command, "--root", "X,Y,Z",
        [&mask](const std::array<double, 3>& at) { mask.root = glm::dvec3(at[0], at[1], at[2]); },
        "Of a mask: the end nearest to this place (mm, RAS) is the root of its piece (default: the thickest end of "
        "each)")
        ->delimiter(',');
    add_option(
        command, "--isovalue", "VALUE", mask.isovalue,
        "Of a scan: what is at least that is inside; a threshold, and no segmentation (default for fractions: 0.5)");
    command.add_flag_callback(
        "--fill-holes", [&mask] { mask.fill_holes = true; },
        "Of a mask: close loops, each where it is thinnest: vessels that touch, holes in the mask");
    add_option(command, "--islands", "MM", mask.islands_mm,
               "Of a mask: leave out pieces that are nowhere longer (default 0)")
        ->check(CLI::NonNegativeNumber.description(""));
    add_option(
        command, "--bulge-size", "X", mask.bulge_size,
        "Of a mask: a bulge of a vessel's wall is a vessel if it extends by more than this times its own thickness "
        "plus a voxel; larger values ignore more of a rough surface (default 0.5)")
        ->check(CLI::NonNegativeNumber.description(""));
}

void add_source_flags(CLI::App& command, SurfaceFlags& flags) {
    add_reading_flags(command, flags);
    add_option_taking<std::string>(
        command, "--labels", "apart|together|N[+M...],...",
        [&flags](const std::string& text) { flags.read.mask.labels = with(io::MaskReading(), "labels", text)->labels; },
        "Of a mask: apart (default, each label a system of its own), together, or the labels of each system")
        ->check(expecting(" is not apart, together, or labels as 1+3,2", [](const std::string& text) {
            return with(io::MaskReading(), "labels", text) && text != "auto";
        }));
    add_mask_reading_flags(command, flags.read.mask);
}

void add_system_flag(CLI::App& command, SurfaceFlags& flags) {
    add_option(command, "--system", "NAME", flags.systems,
               "Only the branches of this vessel system, by its name or its number from 1; may be repeated")
        ->allow_extra_args(false);
}

mesh::SurfaceOptions SurfaceFlags::over(mesh::SurfaceOptions session) const {
    const auto given = [&](const std::string& name) {
        const CLI::Option* option = command == nullptr ? nullptr : command->get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    if (given("--method")) session.method = surface.method;
    for (const SurfaceOption& option : surface_options()) {
        if (option.of_session && !given(flag_of(option.key)))
            continue; // others depend on the machine, not on the session
        option.set(session, option.value(surface));
        if (option.key == "detail") session.cell_mm = 0.0;
    }
    session.memory_bytes = surface.memory_bytes;
    return session;
}

io::ReadOptions SurfaceFlags::over(const io::ReadOptions& session) const {
    io::ReadOptions reading = app::over(read, session);
    const CLI::Option* repair = command != nullptr ? command->get_option_no_throw("--repair") : nullptr;
    if (repair != nullptr && repair->count() > 0) reading.repair = read.repair; // also if it is the default
    const CLI::Option* labels = command != nullptr ? command->get_option_no_throw("--labels") : nullptr;
    if (labels != nullptr && labels->count() > 0) reading.mask.labels = read.mask.labels; // also if it is the default
    return reading;
}

void add_method_flag(CLI::App& command, bool with_masks, const std::function<void(mesh::Method)>& take) {
    std::vector<std::string> keys;
    for (const mesh::MethodRow& row : mesh::kMethods)
        if (row.of_tree || with_masks) keys.emplace_back(row.key);
    add_option_taking<std::string>(
        command, "--method", "METHOD", [take](const std::string& key) { take(*mesh::method_named(key)); },
        mesh::method_help(with_masks))
        ->check(CLI::IsMember(keys));
}

namespace {

CLI::Option* add_surface_flag(CLI::App& command, const SurfaceOption& option, mesh::SurfaceOptions& surface) {
    const std::string name = flag_of(option.key), help(option.help), unit(option.unit);
    if (option.words.empty())
        return add_option_taking<double>(
                   command, name, unit, [&surface, &option](double value) { option.set(surface, value); }, help)
            ->check(domain_of(option));
    std::vector<std::string> words;
    for (const OptionWord& word : option.words) words.emplace_back(word.key);
    return add_option_taking<std::string>(
               command, name, unit,
               [&surface, &option](const std::string& word) { option.set(surface, *value_in(option, word)); }, help)
        ->check(CLI::IsMember(words).description(""));
}

} // namespace

void add_preparing_flags(CLI::App& command, SurfaceFlags& flags, CLI::Option* needing) {
    add_surface_flag(command, *surface_option("smooth"), flags.surface);
    for (const char* key : {"prune", "centerline", "width", "kernel"})
        add_surface_flag(command, *surface_option(key), flags.surface)->needs(needing);
}

void add_surface_flags(CLI::App& command, SurfaceFlags& flags) {
    flags.command = &command;
    mesh::SurfaceOptions& surface = flags.surface;
    for (const SurfaceOption& option : surface_options()) {
        CLI::Option* flag = add_surface_flag(command, option, surface);
        if (!option.instead.empty()) flag->excludes(command.get_option(flag_of(option.instead)));
    }
    command.parse_complete_callback([&command, &surface] {
        if (command.get_option("--kernel")->count() == 0 || command.get_option("--width")->count() == 0) return;
        const field::KernelRow& row = field::row_of(surface.kernel);
        if (row.most_width == 0.0)
            throw CLI::ValidationError("--width", "has no meaning with --kernel " + std::string(row.key));
        if (const auto takes = field::check_width(surface.kernel, surface.width); !takes)
            throw CLI::ValidationError("--width", takes.error().message());
    });
    add_memory_option(command, "--memory", surface.memory_bytes,
                      "Most memory to use, as 800M or 4G (default 0: half of the machine's); ramus mesh makes larger "
                      "surfaces on the disk of the output");
    add_source_flags(command, flags);
}

} // namespace ramus::app
