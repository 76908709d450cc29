// ramus info FILE: what a vessel tree consists of.
#include "app/commands/load_tree.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/volume_info.h"
#include "app/session/numbers.h"
#include "app/session/quantity.h"
#include "core/io/volumes/volume_file.h"
#include "core/measure/tree_measure.h"

#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

struct InfoFlags {
    SurfaceFlags surface;
    std::string file;
    bool json = false;
    bool branches = false;
};

ordered_json range_json(const measure::Range& range) {
    return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

ordered_json point_json(const tree::Point& point) { return {point.position.x, point.position.y, point.position.z}; }

ordered_json quantity_json(const QuantityRow& row, const tree::VesselTree& tree, const TreeFacts& facts, int id) {
    const double value = row.value(tree, facts, id);
    if (row.least != nullptr) return range_json({row.least(facts, id), value, row.largest(facts, id)});
    return row.whole ? ordered_json(static_cast<int>(value)) : ordered_json(value);
}

ordered_json branch_list(const tree::VesselTree& tree, const TreeFacts& facts) {
    ordered_json list = ordered_json::array();
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        ordered_json entry = {
            {"id", id},
            {"parent", branch.parent == tree::kNoBranch ? ordered_json() : ordered_json(branch.parent)},
            {"children", branch.children}};
        for (const QuantityRow* row : rows_with(&QuantityRow::info))
            entry[std::string(row->info.json)] = quantity_json(*row, tree, facts, static_cast<int>(id));
        entry["first"] = point_json(tree.points[branch.points.front()]);
        entry["last"] = point_json(tree.points[branch.points.back()]);
        list.push_back(std::move(entry));
    }
    return list;
}

void print_json(const tree::VesselTree& tree, const measure::TreeStatistics& statistics, bool branches) {
    ordered_json report = {{"branches", tree.branches.size()},
                           {"segments", tree.segment_count()},
                           {"roots", tree.roots.size()},
                           {"loops", tree.loop_count},
                           {"length_mm", statistics.length_mm},
                           {"volume_mm3", statistics.volume_mm3},
                           {"radius_mm", range_json(statistics.radius_mm)},
                           {"generations", statistics.generations},
                           {"repairs", tree.repairs}};
    if (branches) report["branch_list"] = branch_list(tree, facts_of(tree));
    // File names in repairs may hold bytes that are not UTF-8.
    std::cout << report.dump(2, ' ', false, ordered_json::error_handler_t::replace) << '\n';
}

void print_branches(const tree::VesselTree& tree) {
    const TreeFacts facts = facts_of(tree);
    const auto columns = rows_with(&QuantityRow::info);
    const auto cell = [](int width, std::string_view text) { std::cout << std::setw(width) << text; };
    constexpr int kRange = 10; // of least and largest
    std::cout << '\n';
    cell(8, "branch");
    cell(8, "parent");
    for (const QuantityRow* row : columns) {
        cell(row->info.width, row->info.heading);
        if (row->least != nullptr) cell(kRange, "min"), cell(kRange, "max");
    }
    std::cout << '\n';
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) {
        const int parent = tree.branches[static_cast<std::size_t>(id)].parent;
        cell(8, std::to_string(id));
        cell(8, parent == tree::kNoBranch ? "-" : std::to_string(parent));
        for (const QuantityRow* row : columns) {
            const double value = row->value(tree, facts, id);
            cell(row->info.width, row->whole ? std::to_string(static_cast<int>(value)) : rounded(value));
            if (row->least == nullptr) continue;
            cell(kRange, rounded(row->least(facts, id)));
            cell(kRange, rounded(row->largest(facts, id)));
        }
        std::cout << '\n';
    }
}

void print_text(const InfoFlags& flags, const tree::VesselTree& tree, const measure::TreeStatistics& statistics) {
    const auto line = [](const std::string& name, const std::string& value) {
        std::cout << std::left << std::setw(14) << name << std::right << value << '\n';
    };
    std::cout << flags.file << '\n';
    line("branches", grouped(tree.branches.size()) + " (" +
                         counted(static_cast<std::uint64_t>(statistics.leaves), "end", "ends") + ")");
    line("segments", grouped(tree.segment_count()));
    line("roots", grouped(tree.roots.size()));
    line("loops", grouped(static_cast<std::uint64_t>(tree.loop_count)));
    line("generations", std::to_string(statistics.generations) + " (Strahler order " +
                            std::to_string(statistics.highest_strahler) + ")");
    line("length", rounded(statistics.length_mm) + " mm");
    line("volume", rounded(statistics.volume_mm3) + " mm3");
    line("radius", rounded(statistics.radius_mm.min) + " to " + rounded(statistics.radius_mm.max) + " mm, mean " +
                       rounded(statistics.radius_mm.mean) + " mm");
    line("repairs", tree.repairs.empty() ? "none" : grouped(tree.repairs.size()));
    for (const std::string& sentence : tree.repairs) std::cout << "  " << sentence << '\n';
    if (flags.branches) print_branches(tree);
}

Result<int> run_info(const InfoFlags& flags) {
    if (io::names_volume(flags.file)) {
        if (flags.branches)
            return fail("a volume has no branches", flags.file, "leave out --branches, or name a vessel tree");
        return run_volume_info(flags.file, flags.surface, flags.json);
    }
    const auto tree = io::read_tree(flags.file, flags.surface.read);
    if (!tree) return tl::unexpected(tree.error());
    const measure::TreeStatistics statistics = measure::tree_statistics(*tree);
    if (flags.json)
        print_json(*tree, statistics, flags.branches);
    else
        print_text(flags, *tree, statistics);
    return kDone;
}

} // namespace

void register_info(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "info", "Say what a vessel tree or a segmentation mask consists of");
    const auto flags = std::make_shared<InfoFlags>();
    add_option(*command, "FILE", "", flags->file, "Vessel tree, or mask (" + io::readable_volume_extensions() + ")")
        ->required();
    command->add_flag("--json", flags->json, "Print one JSON object");
    command->add_flag("--branches", flags->branches, "List every branch too");
    add_reading_flags(*command, flags->surface);
    command->callback([flags, &chosen] { chosen = [flags] { return run_info(*flags); }; });
}

} // namespace ramus::app
