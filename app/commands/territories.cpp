// `ramus territories TREE --organ MASK`: the parts of an organ by the branches that supply or drain them, and what cuts
// cost.
#include "core/organ/territories.h"

#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_input.h"
#include "app/picture/colouring.h"
#include "app/session/colour_by.h"
#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/printable.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/run_inputs.h"
#include "core/io/volumes/label_map_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/organ/remnant.h"
#include "core/organ/roles.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
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

std::optional<measure::Cut> cut_in(std::string_view word) {
    const std::size_t at = word.find('@');
    const auto branch = parsed<int>(word.substr(0, at));
    const auto where = at == std::string_view::npos ? std::optional(0.0) : parsed<double>(word.substr(at + 1));
    if (!branch || *branch < 0 || !where || !(*where >= 0.0 && *where <= 1.0)) return {};
    return measure::Cut{*branch, *where};
}

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

struct TerritoriesFlags {
    SurfaceFlags reading;
    std::string file, organ, lesions, mask_units, output;
    std::vector<volume::LabelChoice> organ_labels, lesion_labels;
    GroupWish group;
    organ::SupplyOptions supply;
    std::vector<std::string> drains;
    double large_vessels_mm = 5.0;
    bool json = false;
};

// What the files hold.
struct Case {
    tree::VesselTree tree;
    tree::Dependency dependency;
    organ::Organ organ;
    tree::Claims claims;                  // of the organ's mask
    std::vector<organ::Role> roles;       // by system
    std::vector<std::uint8_t> functional; // by voxel
    std::size_t functional_voxels = 0;
};

// By voxel of the organ, 1: the voxel of `mask` that contains its centre is inside.
std::vector<std::uint8_t> sampled(const organ::Organ& organ, const organ::Organ& mask) {
    const glm::dmat4 to_mask = glm::inverse(mask.to_patient()) * organ.to_patient();
    std::vector<std::uint8_t> inside(organ.count(), 0);
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        const glm::dvec3 at(to_mask * glm::dvec4(glm::dvec3(voxel), 1.0));
        inside[number] = mask.mask().test(glm::ivec3(glm::round(at))) ? 1 : 0;
    });
    return inside;
}

// `claims`: receives the mask's, unless null.
Result<organ::Organ> load_organ(const std::string& file, const std::vector<volume::LabelChoice>& labels,
                                const SurfaceFlags& reading, tree::Claims* claims = nullptr) {
    RAMUS_TRY(volume, load_volume(file, reading));
    warn_about(file, volume);
    if (claims != nullptr) *claims = io::claims_of(volume, reading.read.unit);
    return with_progress(
        "organ",
        [&](Job& job) {
            auto organ = organ::organ_of(volume, {labels, {}}, JobRange(job, 0.0F, 1.0F));
            if (!organ && organ.error().where.empty()) organ.error().where = file;
            return organ;
        },
        kNothingWritten);
}

Result<std::vector<organ::Role>> roles_in(const tree::VesselTree& tree, const std::vector<std::string>& drains) {
    std::vector<organ::Role> roles = organ::roles_by_name(tree);
    if (drains.empty()) return roles;
    std::ranges::fill(roles, organ::Role::kSupplies);
    for (const std::string& word : drains) {
        RAMUS_TRY(system, find_system(tree.systems, word));
        roles[static_cast<std::size_t>(system)] = organ::Role::kDrains;
    }
    return roles;
}

Result<Case> load_case(const TerritoriesFlags& flags) {
    RAMUS_TRY(tree, load_tree(flags.file, flags.reading));
    const SurfaceFlags of_masks = with_units(flags.reading, {{}, flags.mask_units});
    tree::Claims claims;
    RAMUS_TRY(organ, load_organ(flags.organ, flags.organ_labels, of_masks, &claims));
    RAMUS_TRY(roles, roles_in(tree, flags.drains));
    for (const int branch : flags.group.branches)
        if (static_cast<std::size_t>(branch) >= tree.branches.size())
            return fail("the tree has no branch " + std::to_string(branch), flags.file,
                        "its branches are 0 to " + std::to_string(tree.branches.size() - 1));
    std::vector<std::uint8_t> functional = organ::large_vessels(organ, tree, flags.large_vessels_mm);
    if (!flags.lesions.empty()) {
        RAMUS_TRY(lesions, load_organ(flags.lesions, flags.lesion_labels, of_masks));
        const std::vector<std::uint8_t> in_lesion = sampled(organ, lesions);
        for (std::size_t n = 0; n < functional.size(); ++n) functional[n] |= in_lesion[n];
    }
    for (std::uint8_t& voxel : functional) voxel ^= 1U;
    const auto count = static_cast<std::size_t>(std::ranges::count(functional, 1));
    tree::Dependency dependency(tree);
    return Case{std::move(tree),
                std::move(dependency),
                std::move(organ),
                claims,
                std::move(roles),
                std::move(functional),
                count};
}

int system_count(const tree::VesselTree& tree) { return std::max(1, static_cast<int>(tree.systems.size())); }

// The systems whose branches divide the organ, not 0: those of --system, else those of the branches that are named,
// else all for a division by systems and the one that supplies for others. Fails if several supply.
Result<std::vector<std::uint8_t>> dividing_systems(const Case& read, const TerritoriesFlags& flags) {
    std::vector<std::uint8_t> chosen(static_cast<std::size_t>(system_count(read.tree)), 0);
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
        return fail("the tree has several systems that supply, and each could divide the organ", flags.file,
                    "name one with --system, or say with --drains which do not supply");
    return chosen;
}

organ::Grouping grouping_of(const Case& read, const GroupWish& wish) {
    switch (wish.kind) {
    case GroupWish::Kind::kGeneration:
        return organ::by_generation(read.tree, wish.generation);
    case GroupWish::Kind::kBranches:
        return organ::by_branches(read.tree, read.dependency, wish.branches);
    case GroupWish::Kind::kCuts:
        return organ::by_cuts(read.tree, read.dependency, wish.cuts);
    case GroupWish::Kind::kSystem:
        break;
    }
    return organ::by_system(read.tree);
}

// Branches of other systems are of no group.
organ::Grouping restricted(organ::Grouping grouping, const tree::VesselTree& tree,
                           const std::vector<std::uint8_t>& systems) {
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (systems[static_cast<std::size_t>(tree.branches[id].system)] == 0) grouping.branches[id] = {};
    return grouping;
}

Result<organ::Supply> supply_by(const Case& read, const organ::Grouping& grouping, const TerritoriesFlags& flags) {
    return with_progress(
        "territories",
        [&](Job& job) {
            return organ::supply_of(read.organ, read.tree, flags.supply, organ::trunk_of(grouping),
                                    JobRange(job, 0.0F, 1.0F));
        },
        kNothingWritten);
}

// What remains of the functional organ after the cuts, by each system on its own.
Result<organ::Remnant> remnant_after(const Case& read, const TerritoriesFlags& flags) {
    const auto systems = static_cast<std::size_t>(system_count(read.tree));
    const std::size_t whole = read.functional_voxels;
    if (flags.group.cuts.empty()) return organ::Remnant{whole, whole, whole, std::vector<std::size_t>(systems, 0)};
    std::vector<organ::Supply> supplies;
    for (std::size_t s = 0; s < systems; ++s) {
        std::vector<std::uint8_t> only(systems, 0);
        only[s] = 1;
        RAMUS_TRY(supply, supply_by(read, restricted(organ::by_system(read.tree), read.tree, only), flags));
        supplies.push_back(std::move(supply));
    }
    std::vector<organ::SystemSupply> parts;
    for (std::size_t s = 0; s < systems; ++s) parts.push_back({read.roles[s], supplies[s].branch, supplies[s].at});
    return organ::remnant_of(parts, measure::lost_spans(read.tree, flags.group.cuts), read.functional);
}

struct Answer {
    std::vector<organ::Territory> territories;
    organ::Remnant remnant;
    std::vector<std::size_t> parts; // of the organ, in voxels
};

std::string name_of_system(const tree::VesselTree& tree, int system) {
    return tree.systems.empty() ? std::string() : system_name(tree.systems, system);
}

nlohmann::ordered_json report_of(const Case& read, const Answer& answer, const TerritoriesFlags& flags) {
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
    nlohmann::ordered_json systems = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < answer.remnant.lost.size(); ++s)
        systems.push_back({{"name", name_of_system(read.tree, static_cast<int>(s))},
                           {"role", read.roles[s] == organ::Role::kDrains ? "drains" : "supplies"},
                           {"lost_ml", volume(answer.remnant.lost[s])}});
    return {{"organ_ml", volume(read.organ.count())},
            {"functional_ml", volume(read.functional_voxels)},
            {"voxels", read.organ.count()},
            {"unit", read.claims.unit_word()},
            {"parts", answer.parts},
            {"by", organ::name_of(flags.supply.rule)},
            {"territories", territories},
            {"systems", systems},
            {"remnant",
             {{"supplied_ml", volume(answer.remnant.supplied)},
              {"drained_ml", volume(answer.remnant.drained)},
              {"congested_ml", volume(answer.remnant.congested())},
              {"unsupplied_ml", volume(answer.remnant.unsupplied())}}}};
}

void print_text(const Case& read, const Answer& answer, const TerritoriesFlags& flags) {
    const double mm3 = 1000.0 * read.organ.voxel_ml();
    const Lengths lengths(read.claims);
    const auto volume = [&](std::size_t voxels) { return lengths.volume(static_cast<double>(voxels) * mm3); };
    std::cout << "organ         " << volume(read.organ.count()) << ", functional " << volume(read.functional_voxels)
              << '\n';
    for (const organ::Territory& one : answer.territories)
        std::cout << printable(one.name) << ": " << volume(one.voxels) << ", "
                  << rounded(100.0 * double(one.voxels) / double(read.organ.count())) << " %, "
                  << counted(one.branches.size(), "branch", "branches") << '\n';
    if (flags.group.cuts.empty()) return;
    std::cout << "remnant       supplied " << volume(answer.remnant.supplied) << ", drained "
              << volume(answer.remnant.drained) << ", congested " << volume(answer.remnant.congested()) << '\n';
}

Result<void> write_labels(const Case& read, const organ::Supply& supply, const organ::Grouping& grouping,
                          const TerritoriesFlags& flags) {
    const std::vector<int> groups = organ::voxel_groups(supply, grouping);
    io::LabelMap map{read.organ.size(), read.organ.to_patient(), read.claims, {}, {}};
    for (std::size_t n = 0; n < grouping.names.size(); ++n)
        map.names.push_back({static_cast<std::int32_t>(n + 1), grouping.names[n], bytes_of(label_colour(n))});
    const auto across = static_cast<std::size_t>(read.organ.size().x);
    map.fill_slice = [&](int k, std::span<std::uint16_t> labels) {
        read.organ.for_voxels(
            {0, 0, k}, {read.organ.size().x, read.organ.size().y, k + 1},
            [&](const glm::ivec3& voxel, std::size_t number) {
                labels[static_cast<std::size_t>(voxel.y) * across + static_cast<std::size_t>(voxel.x)] =
                    static_cast<std::uint16_t>(groups[number] + 1);
            });
    };
    return with_progress(
        "writing", [&](Job& job) { return io::write_label_map(map, flags.output, JobRange(job, 0.0F, 1.0F)); },
        kNothingWritten);
}

Result<int> run_territories(const TerritoriesFlags& flags) {
    for (const std::string* file : {&flags.file, &flags.organ, &flags.lesions})
        if (!file->empty()) io::note_input(*file);
    if (!flags.output.empty())
        if (auto possible = io::check_label_map_output(flags.output); !possible)
            return tl::unexpected(possible.error());
    RAMUS_TRY(read, load_case(flags));
    RAMUS_TRY(systems, dividing_systems(read, flags));
    const organ::Grouping grouping = restricted(grouping_of(read, flags.group), read.tree, systems);
    if (grouping.names.size() > 65534)
        return fail("there are more than 65,534 territories", {}, "group by fewer branches");
    RAMUS_TRY(supply, supply_by(read, grouping, flags));
    Answer answer{organ::territories_of(read.tree, supply, grouping), {}, organ::part_sizes(read.organ)};
    if (flags.group.kind != GroupWish::Kind::kCuts) // groups of other systems; a cut may lose nothing
        std::erase_if(answer.territories, [](const organ::Territory& one) { return one.branches.empty(); });
    RAMUS_TRY(remnant, remnant_after(read, flags));
    answer.remnant = std::move(remnant);
    if (answer.parts.size() > 1)
        std::cerr << "ramus: the organ has " << answer.parts.size() << " parts that do not touch; the largest has "
                  << rounded(100.0 * double(answer.parts.front()) / double(read.organ.count())) << " % of it\n";
    if (!flags.output.empty())
        if (auto written = write_labels(read, supply, grouping, flags); !written)
            return tl::unexpected(written.error());
    if (flags.json)
        std::cout << printed_report(report_of(read, answer, flags), read.claims) << '\n';
    else
        print_text(read, answer, flags);
    return kDone;
}

void add_options(CLI::App& command, TerritoriesFlags& flags) {
    add_input(command, "--organ", "MASK", flags.organ, "Mask of the organ: " + io::readable_volume_extensions())
        ->required();
    add_mask_units_flag(command, flags.mask_units, "the masks");
    const auto add_labels = [&](const char* name, std::vector<volume::LabelChoice>& labels, const char* help) {
        add_option_taking<std::string>(
            command, name, "LABEL,...", [&labels](const std::string& text) { labels = *label_list(text); }, help)
            ->check(expecting(" is not a list of names and whole numbers other than 0", label_list));
    };
    add_labels("--organ-label", flags.organ_labels, "Labels of the mask that are the organ (default: all)");
    add_input(command, "--lesions", "MASK", flags.lesions,
              "Mask of lesions, which are not part of the functional organ");
    add_labels("--lesion-label", flags.lesion_labels, "Labels of that mask that are lesions (default: all)");
    add_option_taking<std::string>(
        command, "--group", "system|generation=N|branches=ID,...|cuts=ID@F,...",
        [&flags](const std::string& text) { flags.group = *group_in(text); },
        "What a territory is of: each vessel system (default), each branch of a generation, each of some branches "
        "with all that depend on it, or what each cut takes away (at fraction F of the branch)")
        ->check(expecting(" is not system, generation=N, branches=ID,... or cuts=ID@F,...", group_in));
    add_option_taking<std::string>(
        command, "--by", "tips|axis|wall",
        [&flags](const std::string& text) { flags.supply.rule = *organ::rule_named(text); },
        "Which branch a voxel belongs to: the nearest, where tips reach further and thick axes less far (default), the "
        "nearest axis, or the nearest wall")
        ->check(expecting(" is not tips, axis or wall", organ::rule_named));
    add_option(command, "--drains", "SYSTEM", flags.drains,
               "Vessel systems that drain the organ, by name or number (default: veins by their names, but the portal "
               "vein)")
        ->delimiter(',');
    add_option(command, "--large-vessels", "MM", flags.large_vessels_mm,
               "Vessels of at least this diameter are not part of the functional organ (default 5)")
        ->check(CLI::Range(0.0, 1e6));
}

} // namespace

void register_territories(CLI::App& app, Action& chosen) {
    CLI::App* command = add_command(app, "territories", "Divide an organ by the branches that supply or drain it");
    command->footer(
        "Territories are estimated by distance, since a scan shows the thick branches only: a voxel belongs "
        "to the branch whose visible tip, less 6 of its radii, or whose axis, plus 4, is nearest. See the "
        "guide for how sure they are.");
    const auto flags = std::make_shared<TerritoriesFlags>();
    add_input(*command, "TREE", "", flags->file, "Vessel tree, or a mask of vessels")->required();
    add_options(*command, *flags);
    add_option(*command, "-o,--output", "FILE", flags->output, "Label map to write: " + io::label_map_extensions());
    flags->reading.command = command;
    add_source_flags(*command, flags->reading);
    add_system_flag(*command, flags->reading);
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    command->callback([flags, &chosen] { chosen = [flags] { return run_territories(*flags); }; });
}

} // namespace ramus::app
