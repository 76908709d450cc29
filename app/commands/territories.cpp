// `ramus territories TREE --organ MASK`: the parts of an organ by the branches that supply or drain them, and what cuts
// cost.
#include "core/organ/territories.h"

#include "app/commands/inputs.h"
#include "app/commands/organ_case.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/suggest_cuts.h"
#include "app/picture/organ_files.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/printable.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/label_map_file.h"
#include "core/organ/certainty.h"
#include "core/organ/label_surfaces.h"
#include "core/organ/remnant.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::app {

namespace {

// What --group asks for.
struct GroupWish {
    enum class Kind : std::uint8_t { kSystem, kGeneration, kBranches, kCuts };
    Kind kind = Kind::kSystem;
    int generation = 0;
    std::vector<int> branches;      // of kBranches and kCuts
    std::vector<measure::Cut> cuts; // of kCuts, one for each of `branches`
};

std::optional<GroupWish> group_in(std::string_view text) {
    GroupWish wish;
    if (text == "system") return wish;
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return {};
    const std::string_view kind = text.substr(0, equals), value = text.substr(equals + 1);
    if (kind == "generation") {
        const auto generation = parsed<int>(value);
        if (!generation || *generation < 0) return {};
        wish.kind = GroupWish::Kind::kGeneration;
        wish.generation = *generation;
        return wish;
    }
    if (kind != "branches" && kind != "cuts") return {};
    wish.kind = kind == "cuts" ? GroupWish::Kind::kCuts : GroupWish::Kind::kBranches;
    std::vector<std::string_view> words;
    io::split_words(value, ",", words);
    for (const std::string_view word : words) {
        const auto cut = cut_in(word);
        if (!cut || (kind == "branches" && word.find('@') != std::string_view::npos)) return {};
        if (std::ranges::find(wish.branches, cut->first) != wish.branches.end()) return {};
        wish.branches.push_back(cut->first);
        if (wish.kind == GroupWish::Kind::kCuts) wish.cuts.push_back(*cut);
    }
    return wish.branches.empty() ? std::nullopt : std::optional(wish);
}

struct TerritoriesFlags : OrganFlags {
    std::string output, surfaces;
    GroupWish group;
    CutWish cuts;
    bool json = false;
};

// The systems whose branches divide the organ, not 0: those of --system, else those of the branches that are named,
// else all for a division by systems and the one that supplies for others. Fails if several supply.
Result<std::vector<std::uint8_t>> dividing_systems(const OrganCase& read, const TerritoriesFlags& flags) {
    std::vector<std::uint8_t> chosen(read.system_count(), 0);
    for (const std::string& word : flags.reading.systems) {
        RAMUS_TRY(system, find_system(read.tree.systems, word));
        chosen[static_cast<std::size_t>(system)] = 1;
    }
    for (const int branch : flags.group.branches)
        chosen[static_cast<std::size_t>(read.tree.branches[static_cast<std::size_t>(branch)].system)] = 1;
    if (std::ranges::find(chosen, 1) != chosen.end()) return chosen;
    for (std::size_t s = 0; s < chosen.size(); ++s)
        chosen[s] = flags.group.kind == GroupWish::Kind::kSystem || read.roles[s] == organ::Role::kSupplies ? 1 : 0;
    if (flags.group.kind != GroupWish::Kind::kSystem && std::ranges::count(chosen, 1) > 1)
        return fail("the tree has several systems that supply, and each could divide the organ", flags.tree,
                    "name one with --system, or say with --drains which do not supply");
    return chosen;
}

organ::Grouping grouping_of(const tree::VesselTree& tree, const tree::Dependency& dependency, const GroupWish& wish) {
    switch (wish.kind) {
    case GroupWish::Kind::kGeneration:
        return organ::by_generation(tree, wish.generation);
    case GroupWish::Kind::kBranches:
        return organ::by_branches(tree, dependency, wish.branches);
    case GroupWish::Kind::kCuts:
        return organ::by_cuts(tree, dependency, wish.cuts);
    case GroupWish::Kind::kSystem:
        break;
    }
    return organ::by_system(tree);
}

// What remains of the functional organ after the cuts, by each system on its own.
Result<organ::Remnant> remnant_after(const OrganCase& read, const TerritoriesFlags& flags) {
    const std::size_t whole = read.functional_voxels;
    if (flags.group.cuts.empty())
        return organ::Remnant{whole, whole, whole, std::vector<std::size_t>(read.system_count(), 0)};
    RAMUS_TRY(systems, supplies_by_system(read, flags));
    return organ::remnant_of(systems.parts, measure::lost_spans(read.tree, flags.group.cuts), read.functional);
}

struct Answer {
    std::vector<organ::Territory> territories;
    organ::Remnant remnant;
    std::vector<PartSurface> surfaces;
    std::optional<CutAnswer> cuts;
    std::optional<organ::Certainty> expected;
};

// How sure territories by tips of one system are on average. None where that was not measured.
std::optional<organ::Certainty> expected_of(const OrganCase& read, const Answer& answer,
                                            const std::vector<std::uint8_t>& systems, const TerritoriesFlags& flags) {
    if (flags.supply.rule != organ::Rule::kTips || std::ranges::count(systems, 1) != 1) return std::nullopt;
    const auto filled =
        std::ranges::count_if(answer.territories, [](const organ::Territory& one) { return one.voxels > 0; });
    return organ::expected_certainty(organ::visible_branches(read.organ, read.tree, systems),
                                     static_cast<std::size_t>(filled));
}

nlohmann::ordered_json report_of(const OrganCase& read, const Answer& answer, const TerritoriesFlags& flags) {
    const double ml = read.organ.voxel_ml();
    const auto volume = [&](std::size_t voxels) { return static_cast<double>(voxels) * ml; };
    nlohmann::ordered_json territories = nlohmann::ordered_json::array();
    for (const organ::Territory& one : answer.territories)
        territories.push_back({{"name", one.name},
                               {"system", name_of_system(read.tree, one.system)},
                               {"branches", one.branches},
                               {"voxels", one.voxels},
                               {"volume_ml", volume(one.voxels)},
                               {"percent", 100.0 * static_cast<double>(one.voxels) / double(read.organ.count())}});
    const auto expected = [&](double organ::Certainty::*figure) {
        return answer.expected ? nlohmann::ordered_json((*answer.expected).*figure) : nlohmann::ordered_json();
    };
    nlohmann::ordered_json systems = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < answer.remnant.lost.size(); ++s)
        systems.push_back({{"name", name_of_system(read.tree, static_cast<int>(s))},
                           {"role", read.roles[s] == organ::Role::kDrains ? "drains" : "supplies"},
                           {"lost_ml", volume(answer.remnant.lost[s])}});
    nlohmann::ordered_json surfaces = nlohmann::ordered_json::array();
    for (const PartSurface& one : answer.surfaces)
        surfaces.push_back({{"name", one.name}, {"file", one.file}, {"triangles", one.triangles}});
    nlohmann::ordered_json report{{"organ_ml", volume(read.organ.count())},
                                  {"functional_ml", volume(read.functional_voxels)},
                                  {"voxels", read.organ.count()},
                                  {"unit", read.claims.unit_word()},
                                  {"parts", read.parts},
                                  {"by", organ::name_of(flags.supply.rule)},
                                  {"expected_dice", expected(&organ::Certainty::dice)},
                                  {"expected_error_percent", expected(&organ::Certainty::error_percent)},
                                  {"territories", territories},
                                  {"systems", systems},
                                  {"remnant",
                                   {{"supplied_ml", volume(answer.remnant.supplied)},
                                    {"drained_ml", volume(answer.remnant.drained)},
                                    {"congested_ml", volume(answer.remnant.congested())},
                                    {"unsupplied_ml", volume(answer.remnant.unsupplied())}}},
                                  {"surfaces", surfaces}};
    if (answer.cuts) report["fewest_cuts"] = json_of(read, *answer.cuts);
    return report;
}

void print_text(const OrganCase& read, const Answer& answer, const TerritoriesFlags& flags) {
    const double mm3 = 1000.0 * read.organ.voxel_ml();
    const Lengths lengths(read.claims);
    const auto volume = [&](std::size_t voxels) { return lengths.volume(static_cast<double>(voxels) * mm3); };
    std::cout << "organ         " << volume(read.organ.count()) << ", functional " << volume(read.functional_voxels)
              << '\n';
    for (const organ::Territory& one : answer.territories)
        std::cout << printable(one.name) << ": " << volume(one.voxels) << ", "
                  << rounded(100.0 * double(one.voxels) / double(read.organ.count())) << " %, "
                  << counted(one.branches.size(), "branch", "branches") << '\n';
    if (answer.expected)
        std::cout << "expected      Dice " << rounded(answer.expected->dice) << ", volumes off by "
                  << rounded(answer.expected->error_percent) << " % on average, as in grown organs\n";
    if (answer.cuts) print_cuts(read, *answer.cuts);
    if (flags.group.cuts.empty()) return;
    std::cout << "remnant       supplied " << volume(answer.remnant.supplied) << ", drained "
              << volume(answer.remnant.drained) << ", congested " << volume(answer.remnant.congested()) << '\n';
}

// The label map and the surfaces that are wanted.
Result<void> write_files(const OrganCase& read, const organ::Supply& supply, const organ::Grouping& grouping,
                         const TerritoriesFlags& flags, Answer& answer) {
    if (flags.output.empty() && flags.surfaces.empty()) return {};
    const std::vector<int> groups = organ::voxel_groups(supply, grouping);
    const auto label_of = [&](std::size_t number) { return static_cast<std::uint16_t>(groups[number] + 1); };
    if (!flags.output.empty())
        if (auto written = write_case_labels(read, grouping.names, label_of, flags.output); !written) return written;
    if (flags.surfaces.empty()) return {};
    RAMUS_TRY(surfaces,
              with_progress(
                  "surfaces",
                  [&](Job& job) { return organ::label_surfaces(read.organ, groups, JobRange(job, 0.0F, 1.0F)); },
                  kNothingWritten));
    std::vector<mesh::TriangleMesh> parts;
    for (std::size_t n = 0; n < grouping.names.size(); ++n)
        parts.push_back(organ::surface_of(surfaces, static_cast<int>(n)));
    RAMUS_TRY(written, write_organ_surfaces(parts_of(read.organ, read.claims, grouping.names), std::move(parts),
                                            flags.surfaces));
    answer.surfaces = std::move(written);
    return {};
}

Result<int> run_territories(const TerritoriesFlags& flags) {
    if (!flags.output.empty())
        if (auto possible = io::check_label_map_output(flags.output); !possible)
            return tl::unexpected(possible.error());
    if (!flags.surfaces.empty())
        if (auto format = io::mesh_format(flags.surfaces); !format) return tl::unexpected(format.error());
    RAMUS_TRY(read, load_case(flags));
    for (const int branch : flags.group.branches)
        if (auto there = check_branch(read.tree, branch, flags.tree); !there) return tl::unexpected(there.error());
    const tree::Dependency dependency(read.tree);
    RAMUS_TRY(systems, dividing_systems(read, flags));
    organ::Grouping grouping = grouping_of(read.tree, dependency, flags.group);
    organ::restrict_to(grouping, read.tree, systems);
    if (auto few = organ::check_count(grouping); !few) return tl::unexpected(few.error());
    RAMUS_TRY(supply, supply_by(read, flags, organ::trunk_of(grouping)));
    Answer answer{organ::territories_of(read.tree, supply, grouping), {}, {}, {}, {}};
    if (flags.group.kind != GroupWish::Kind::kCuts) // groups of other systems; a cut may lose nothing
        std::erase_if(answer.territories, [](const organ::Territory& one) { return one.branches.empty(); });
    answer.expected = expected_of(read, answer, systems, flags);
    RAMUS_TRY(remnant, remnant_after(read, flags));
    answer.remnant = std::move(remnant);
    if (flags.cuts.margin_mm) {
        RAMUS_TRY(cuts, suggest_cuts(read, flags, flags.cuts));
        answer.cuts = std::move(cuts);
    }
    if (auto written = write_files(read, supply, grouping, flags, answer); !written)
        return tl::unexpected(written.error());
    if (flags.json)
        std::cout << printed_report(report_of(read, answer, flags), read.claims) << '\n';
    else
        print_text(read, answer, flags);
    return kDone;
}

} // namespace

void register_territories(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "territories", "Divide an organ by the branches that supply or drain it");
    command->footer(
        "Territories are estimated by distance, since a scan shows the thick branches only: a voxel belongs "
        "to the branch whose visible tip, less 6 of its radii, or whose axis, plus 4, is nearest. See the "
        "guide for how sure they are.");
    const auto flags = std::make_shared<TerritoriesFlags>();
    add_input(*command, "TREE", "", flags->tree, "Vessel tree, or a mask of vessels")->required();
    add_organ_options(*command, *flags);
    add_option_taking<std::string>(
        *command, "--group", "system|generation=N|branches=ID,...|cuts=ID@F,...",
        [flags](const std::string& text) { flags->group = *group_in(text); },
        "What a territory is of: each vessel system (default), each branch of a generation, each of some branches "
        "with all that depend on it, or what each cut takes away (at fraction F of the branch)")
        ->check(expecting(" is not system, generation=N, branches=ID,... or cuts=ID@F,...", group_in));
    add_cut_options(*command, flags->cuts);
    add_option(*command, "-o,--output", "FILE", flags->output, "Label map to write: " + io::label_map_extensions());
    add_option(*command, "--surfaces", "FILE", flags->surfaces,
               "Surfaces to write, closed, one of each territory: " + io::writable_mesh_extensions() +
                   "; VTP and GLB hold all, other formats get a file each, named after its territory");
    flags->reading.command = command;
    add_source_flags(*command, flags->reading);
    add_system_flag(*command, flags->reading);
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    command->callback([flags, &chosen] { chosen = [flags] { return run_territories(*flags); }; });
}

} // namespace ramus::app
