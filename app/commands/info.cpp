// ramus info FILE: what a vessel tree, a mask or a scan consists of.
#include "app/assets/contacts.h"
#include "app/commands/command.h"
#include "app/commands/info_contacts.h"
#include "app/commands/info_parts.h"
#include "app/commands/info_table.h"
#include "app/commands/info_volume.h"
#include "app/commands/inputs.h"
#include "app/commands/printed_report.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/session/numbers.h"
#include "app/session/quantity.h"
#include "app/session/smoothing_text.h"
#include "app/session/systems.h"
#include "app/storage/opening_files.h"
#include "core/base/error.h"
#include "core/base/printable.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/measure/tree_measure.h"
#include "core/tree/branch_data.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

struct InfoFlags {
    SurfaceFlags surface;
    std::vector<std::string> files;
    bool json = false, csv = false;
    bool branches = false, contacts = false;
};

// Prints the results of one file after the other, as text, as JSON, or as rows of one table.
class InfoPrinter {
public:
    explicit InfoPrinter(const InfoFlags& flags) : flags_(flags) {}
    [[nodiscard]] bool several() const { return flags_.files.size() > 1; }

    void print_json(const std::string& file, const ordered_json& report, const tree::Claims& claims) {
        ordered_json named;
        if (several()) named["file"] = io::input_name(file);
        named.update(report);
        std::cout << (several() ? printed_++ > 0 ? ",\n" : "{\"files\": [\n" : "")
                  << printed_report(std::move(named), claims) << (several() ? "" : "\n");
    }
    // Before the text of a file.
    void begin_text() { std::cout << (printed_++ > 0 ? "\n" : ""); }
    void print_row(const Table& table) {
        std::string text = csv_lines(table);
        if (printed_++ > 0) text.erase(0, text.find('\n') + 1); // the names of the columns
        std::cout << text << std::flush;
    }
    void end() const {
        if (flags_.json && several()) std::cout << (printed_ > 0 ? "\n]}\n" : "{\"files\": []}\n");
    }

private:
    const InfoFlags& flags_;
    std::size_t printed_ = 0;
};

// Prints the properties of a mask or scan.
Result<void> print_volume_of(const std::string& file, const InfoFlags& flags, InfoPrinter& printer) {
    RAMUS_TRY(volume, load_volume(file, flags.surface));
    if (flags.csv) {
        printer.print_row(info_row(file));
        return {};
    }
    if (flags.json) {
        printer.print_json(file, volume_json(volume), io::claims_of(volume, flags.surface.read.unit));
    } else {
        printer.begin_text();
        print_volume(io::input_name(file), volume);
    }
    return {};
}

// The contacts of the prepared tree; null: not requested.
using SharedContacts = std::shared_ptr<const std::vector<tree::Contact>>;

ordered_json range_json(const measure::Range& range) {
    return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

ordered_json quantity_json(const QuantityRow& row, const tree::VesselTree& tree, const TreeFacts& facts, int id) {
    const double value = row.value(tree, facts, id);
    if (row.least != nullptr) return range_json({row.least(facts, id), value, row.largest(facts, id)});
    return row.whole ? ordered_json(static_cast<int>(value)) : ordered_json(value);
}

ordered_json known_number(double value) { return tree::is_known(value) ? ordered_json(value) : ordered_json(); }

ordered_json mean_values(const tree::VesselTree& tree, int id) {
    ordered_json values = ordered_json::object();
    for (const auto& [name, value] : tree::data_of(tree, id)) values[name] = known_number(value);
    return values;
}

ordered_json data_json(const tree::VesselTree& tree) {
    ordered_json list = ordered_json::array();
    for (const auto& [of, arrays] : {std::pair("points", &tree.point_data), std::pair("branches", &tree.branch_data)})
        for (const tree::DataArray& array : *arrays) {
            const tree::DataRange range = range_of(array);
            list.push_back({{"name", array.name},
                            {"of", of},
                            {"min", known_number(range.least)},
                            {"max", known_number(range.largest)},
                            {"known", range.known},
                            {"unknown", range.unknown}});
        }
    return list;
}

ordered_json branch_list(const tree::VesselTree& tree, const TreeFacts& facts) {
    ordered_json list = ordered_json::array();
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        ordered_json entry = {
            {"id", id},
            {"parent", branch.parent == tree::kNoBranch ? ordered_json() : ordered_json(branch.parent)},
            {"children", branch.children}};
        if (!tree.systems.empty()) entry["system"] = system_name(tree.systems, branch.system);
        for (const QuantityRow* row : rows_with(&QuantityRow::info))
            entry[std::string(row->info.json)] = quantity_json(*row, tree, facts, static_cast<int>(id));
        if (ordered_json data = mean_values(tree, static_cast<int>(id)); !data.empty()) entry["data"] = std::move(data);
        entry["first"] = list_of(tree.points[branch.points.front()].position);
        entry["last"] = list_of(tree.points[branch.points.back()].position);
        list.push_back(std::move(entry));
    }
    return list;
}

std::vector<std::string> names_of(const std::vector<tree::System>& systems) {
    std::vector<std::string> names;
    for (const tree::System& system : systems) names.push_back(system.name);
    return names;
}

ordered_json system_list(const tree::VesselTree& tree) {
    ordered_json list = ordered_json::array();
    const std::vector<SystemFacts> facts = system_facts(tree, facts_of(tree), {});
    for (std::size_t i = 0; i < facts.size(); ++i)
        list.push_back({{"name", tree.systems[i].name},
                        {"colour", colour_text(tree.systems[i].colour)},
                        {"branches", facts[i].branches},
                        {"length_mm", facts[i].length_mm},
                        {"volume_mm3", facts[i].volume_mm3}});
    return list;
}

ordered_json notes_json(const tree::VesselTree& tree) {
    ordered_json notes = ordered_json::array();
    for (const tree::Note& note : tree.notes) {
        notes.push_back({{"kind", tree::name_of(note.kind)}, {"topic", note.topic}, {"text", note.text}});
        if (note.at) notes.back()["at"] = list_of(*note.at);
        if (note.outward) notes.back()["outward"] = list_of(*note.outward);
    }
    return notes;
}

// "114 loops, 2 radius-jumps"
std::string topics_of(const std::vector<tree::NoteGroup>& groups, tree::Note::Kind kind) {
    std::string list;
    for (const tree::NoteGroup& group : groups)
        if (group.kind == kind) list += (list.empty() ? "" : ", ") + grouped(group.notes.size()) + " " + group.topic;
    return list;
}

ordered_json tree_json(const InfoFlags& flags, const tree::VesselTree& tree, const measure::TreeStatistics& statistics,
                       const SharedContacts& contacts) {
    ordered_json report = {{"branches", tree.branches.size()},
                           {"segments", tree.segment_count()},
                           {"roots", tree.roots.size()},
                           {"loops", tree.loop_count},
                           {"length_mm", statistics.length_mm},
                           {"volume_mm3", statistics.volume_mm3},
                           {"radius_mm", range_json(statistics.radius_mm)},
                           {"units", tree.claims.unit_word()},
                           {"units_said_by", tree::name_of(tree.claims.unit)},
                           {"orientation", tree.claims.axes_word()},
                           {"orientation_said_by", tree::name_of(tree.claims.orientation)},
                           {"generations", statistics.generations},
                           {"dependency_known", !nothing_depends(facts_of(tree))},
                           {"repairs", sentences(tree, tree::Note::Kind::kRepaired)},
                           {"assumptions", sentences(tree, tree::Note::Kind::kAssumed)},
                           {"suspicions", sentences(tree, tree::Note::Kind::kSuspect)},
                           {"notes", notes_json(tree)},
                           {"systems", names_of(tree.systems)},
                           {"smoothing", smoothing_json(smoothing_of(tree, flags.surface.surface.smooth_passes))}};
    report["data"] = data_json(tree);
    if (!tree.systems.empty()) report["system_list"] = system_list(tree);
    if (flags.branches) report["branch_list"] = branch_list(tree, facts_of(tree));
    if (contacts) report["contacts"] = contacts_json(*contacts);
    return report;
}

// The width of the column of systems; 0: the tree has no systems.
std::size_t system_width(const tree::VesselTree& tree) {
    std::size_t widest = 0;
    for (int system = 0; system < static_cast<int>(tree.systems.size()); ++system)
        widest = std::max({widest, std::string_view("system").size(), system_name(tree.systems, system).size()});
    return widest == 0 ? 0 : widest + 2;
}

void print_branches(const tree::VesselTree& tree) {
    const TreeFacts facts = facts_of(tree);
    const auto columns = rows_with(&QuantityRow::info);
    const auto cell = [](int width, std::string_view text) { std::cout << std::setw(width) << text; };
    constexpr int kRange = 10; // width of the columns min and max
    const auto heading = [&](const QuantityRow* row) { return Lengths(tree.claims).worded(row->info.heading); };
    std::cout << '\n';
    cell(8, "branch");
    cell(8, "parent");
    const std::size_t widest = system_width(tree);
    if (widest > 0) cell(static_cast<int>(widest), "system");
    for (const QuantityRow* row : columns) {
        cell(std::max(row->info.width, static_cast<int>(heading(row).size()) + 2), heading(row));
        if (row->least != nullptr) cell(kRange, "min"), cell(kRange, "max");
    }
    const auto data_width = [](const std::string& name) { return std::max(10, static_cast<int>(name.size()) + 2); };
    for (const tree::DataArrays* arrays : {&tree.point_data, &tree.branch_data})
        for (const tree::DataArray& array : *arrays) cell(data_width(array.name), array.name);
    std::cout << '\n';
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) {
        const int parent = tree.branches[static_cast<std::size_t>(id)].parent;
        cell(8, std::to_string(id));
        cell(8, parent == tree::kNoBranch ? "-" : std::to_string(parent));
        if (widest > 0)
            cell(static_cast<int>(widest),
                 system_name(tree.systems, tree.branches[static_cast<std::size_t>(id)].system));
        for (const QuantityRow* row : columns) {
            const double value = row->value(tree, facts, id);
            cell(std::max(row->info.width, static_cast<int>(heading(row).size()) + 2),
                 row->whole ? std::to_string(static_cast<int>(value)) : rounded(value));
            if (row->least == nullptr) continue;
            cell(kRange, rounded(row->least(facts, id)));
            cell(kRange, rounded(row->largest(facts, id)));
        }
        const ordered_json means = mean_values(tree, id);
        for (const auto& [name, value] : means.items())
            cell(data_width(name), value.is_null() ? "-" : rounded(value.get<double>()));
        std::cout << '\n';
    }
}

void print_systems(const tree::VesselTree& tree) {
    if (tree.systems.empty()) return;
    const std::vector<SystemFacts> facts = system_facts(tree, facts_of(tree), {});
    print_fact("systems", std::to_string(facts.size()));
    for (std::size_t i = 0; i < facts.size(); ++i)
        std::cout << "  " << system_name(tree.systems, static_cast<int>(i)) << ": "
                  << counted(static_cast<std::uint64_t>(facts[i].branches), "branch", "branches") << ", "
                  << Lengths(tree.claims).text(facts[i].length_mm) + ", " << colour_text(tree.systems[i].colour)
                  << '\n';
}

void print_data(const tree::VesselTree& tree) {
    if (tree.point_data.empty() && tree.branch_data.empty()) return;
    print_fact("data", std::to_string(tree.point_data.size() + tree.branch_data.size()));
    for (const auto& [of, arrays] : {std::pair("points", &tree.point_data), std::pair("branches", &tree.branch_data)})
        for (const tree::DataArray& array : *arrays) {
            const tree::DataRange range = range_of(array);
            std::cout << "  " << array.name << ", of " << of << ": "
                      << (range.known > 0 ? rounded(range.least) + " to " + rounded(range.largest) : "nothing known")
                      << (range.unknown > 0 ? ", " + grouped(range.unknown) + " not known" : "") << '\n';
        }
}

std::string claim_text(tree::SaidBy said_by, const std::string& known, const std::string& open) {
    return said_by == tree::SaidBy::kNobody
               ? open
               : known + (said_by == tree::SaidBy::kFile ? ", says the file" : ", as asked for");
}

void print_text(const std::string& file, const InfoFlags& flags, const tree::VesselTree& tree,
                const measure::TreeStatistics& statistics, const SharedContacts& contacts) {
    std::cout << file << '\n';
    print_fact("branches", grouped(tree.branches.size()) + " (" +
                               counted(static_cast<std::uint64_t>(statistics.leaves), "leaf", "leaves") + ")");
    print_fact("segments", grouped(tree.segment_count()));
    print_fact("roots", grouped(tree.roots.size()));
    print_fact("loops", grouped(static_cast<std::uint64_t>(tree.loop_count)));
    print_fact("generations", std::to_string(statistics.generations) + " (Strahler order " +
                                  std::to_string(statistics.highest_strahler) + ")");
    const Lengths lengths(tree.claims);
    print_fact("length", lengths.text(statistics.length_mm));
    print_fact("volume", lengths.volume(statistics.volume_mm3));
    print_fact("radius", lengths.text(statistics.radius_mm.min) + " to " + lengths.text(statistics.radius_mm.max) +
                             ", mean " + lengths.text(statistics.radius_mm.mean));
    if (nothing_depends(facts_of(tree))) print_fact("dependency", kNothingDepends);
    print_fact("smoothing", smoothing_text(smoothing_of(tree, flags.surface.surface.smooth_passes), lengths));
    print_fact("unit", claim_text(tree.claims.unit, "mm", "not known"));
    print_fact("orientation", claim_text(tree.claims.orientation, "RAS", "not known"));
    const std::vector<tree::NoteGroup> groups = note_groups(tree);
    for (const auto& [kind, heading] :
         {std::pair(tree::Note::Kind::kRepaired, "repairs"), std::pair(tree::Note::Kind::kAssumed, "assumptions"),
          std::pair(tree::Note::Kind::kSuspect, "suspicions")}) {
        const std::vector<std::string> found = sentences(tree, kind);
        print_fact(heading, found.empty() ? "none" : grouped(found.size()) + " (" + topics_of(groups, kind) + ")");
        for (const std::string& sentence : found) std::cout << "  " << sentence << '\n';
    }
    print_data(tree);
    print_systems(tree);
    if (contacts) print_contacts(std::cout, tree, *contacts);
    if (flags.branches) print_branches(tree);
}

Result<void> print_file(const std::string& file, const InfoFlags& flags, InfoPrinter& printer) {
    if (io::is_volume(file)) {
        if (flags.branches || flags.contacts)
            return fail("a volume has no branches", io::input_name(file),
                        std::string("leave out ") + (flags.branches ? "--branches" : "--contacts") +
                            ", or name a vessel tree");
        return print_volume_of(file, flags, printer);
    }
    if (is_session_file(file))
        return fail("this is a session, where a vessel tree or a mask is needed", file,
                    "name its tree's file; ramus render --session draws it");
    RAMUS_TRY(tree, io::read_tree(file, flags.surface.read));
    const measure::TreeStatistics statistics = measure::tree_statistics(tree);
    if (flags.csv) {
        printer.print_row(info_row(file, tree, statistics));
        return {};
    }
    const SharedContacts contacts = flags.contacts ? contacts_of(tree, flags.surface.surface).list : nullptr;
    if (flags.json) {
        printer.print_json(file, tree_json(flags, tree, statistics, contacts), tree.claims);
    } else {
        printer.begin_text();
        print_text(io::input_name(file), flags, tree, statistics, contacts);
    }
    return {};
}

// Continues with the other files if one of them fails. Only one file is in memory at a time.
Result<int> run_info(const InfoFlags& flags) {
    InfoPrinter printer(flags);
    bool failed = false;
    for (const std::string& file : flags.files) {
        Result<void> printed;
        try {
            printed = print_file(file, flags, printer);
        } catch (const std::bad_alloc&) {
            printed = fail("not enough memory for this file", io::input_name(file));
        }
        if (printed) continue;
        if (!printer.several() && !flags.csv) return tl::unexpected(printed.error());
        failed = true;
        std::cout << std::flush; // keeps the order of files if both streams go to the same place
        std::cerr << "ramus: " << printable(printed.error().message()) << '\n';
        if (flags.csv) {
            printer.print_row(info_row(file, printed.error()));
        } else if (flags.json) {
            printer.print_json(file, {{"error", printed.error().message()}}, {});
        }
    }
    printer.end();
    return failed ? kFailed : kDone;
}

} // namespace

void register_info(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "info", "Say what a vessel tree or a segmentation mask consists of");
    const auto flags = std::make_shared<InfoFlags>();
    add_input(*command, "FILE", "", flags->files,
              "Vessel trees, or masks (" + io::readable_volume_extensions() + "); - is standard input")
        ->required();
    CLI::Option* json =
        command->add_flag("--json", flags->json, "Print one JSON object; of several files {\"files\": [...]}");
    CLI::Option* csv = command->add_flag("--csv", flags->csv, "Print a table, a row for each file")->excludes(json);
    csv->excludes(command->add_flag("--branches", flags->branches, "List every branch too"));
    CLI::Option* contacts = command->add_flag("--contacts", flags->contacts,
                                              "List where vessels press on each other without being connected there");
    csv->excludes(contacts);
    add_preparing_flags(*command, flags->surface, contacts);
    add_reading_flags(*command, flags->surface);
    command->callback([flags, &chosen] { chosen = [flags] { return run_info(*flags); }; });
}

} // namespace ramus::app
