#include "app/commands/organ_case.h"

#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/commands/progress.h"
#include "app/commands/surface_input.h"
#include "app/picture/organ_files.h"
#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/printable.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/run_inputs.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/organ/roles.h"
#include "core/organ/territories.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <iostream>
#include <utility>

namespace ramus::app {

namespace {

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

Result<std::vector<organ::Role>> roles_in(const tree::VesselTree& tree, const std::vector<std::string>& drains) {
    std::vector<organ::Role> roles = organ::roles_by_name(tree.systems);
    if (drains.empty()) return roles;
    std::ranges::fill(roles, organ::Role::kSupplies);
    for (const std::string& word : drains) {
        RAMUS_TRY(system, find_system(tree.systems, word));
        roles[static_cast<std::size_t>(system)] = organ::Role::kDrains;
    }
    return roles;
}

} // namespace

std::optional<measure::Cut> cut_in(std::string_view word) {
    const std::size_t at = word.find('@');
    const auto branch = parsed<int>(word.substr(0, at));
    const auto where = at == std::string_view::npos ? std::optional(0.0) : parsed<double>(word.substr(at + 1));
    if (!branch || *branch < 0 || !where || !(*where >= 0.0 && *where <= 1.0)) return {};
    return measure::Cut{*branch, *where};
}

std::optional<std::vector<measure::Cut>> cuts_in(std::string_view text) {
    std::vector<std::string_view> words;
    io::split_words(text, ",", words);
    std::vector<measure::Cut> cuts;
    for (const std::string_view word : words) {
        const auto cut = cut_in(word);
        if (!cut || std::ranges::find(cuts, cut->first, &measure::Cut::first) != cuts.end()) return {};
        cuts.push_back(*cut);
    }
    return cuts.empty() ? std::nullopt : std::optional(cuts);
}

Result<void> check_branch(const tree::VesselTree& tree, int branch, const std::string& file) {
    if (static_cast<std::size_t>(branch) < tree.branches.size()) return {};
    return fail("the tree has no branch " + std::to_string(branch), file,
                "its branches are 0 to " + std::to_string(tree.branches.size() - 1));
}

SurfaceFlags mask_flags(const OrganFlags& flags) { return with_units(flags.reading, {{}, flags.mask_units}); }

Result<organ::Organ> load_organ(const std::string& file, const std::vector<volume::LabelChoice>& labels,
                                const SurfaceFlags& reading, tree::Claims* claims) {
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

Result<OrganCase> load_case(const OrganFlags& flags) {
    for (const std::string* file : {&flags.tree, &flags.organ, &flags.lesions})
        if (!file->empty()) io::note_input(*file);
    RAMUS_TRY(tree, load_tree(flags.tree, flags.reading));
    tree::Claims claims;
    RAMUS_TRY(organ, load_organ(flags.organ, flags.organ_labels, mask_flags(flags), &claims));
    std::vector<std::size_t> parts = organ::part_sizes(organ);
    if (parts.size() > 1)
        std::cerr << "ramus: the organ has " << parts.size() << " parts that do not touch; the largest has "
                  << rounded(100.0 * double(parts.front()) / double(organ.count())) << " % of it\n";
    RAMUS_TRY(roles, roles_in(tree, flags.drains));
    std::vector<std::uint8_t> functional = organ::large_vessels(organ, tree, flags.large_vessels_mm);
    if (!flags.lesions.empty()) {
        RAMUS_TRY(lesions, load_organ(flags.lesions, flags.lesion_labels, mask_flags(flags)));
        const std::vector<std::uint8_t> in_lesion = sampled(organ, lesions);
        for (std::size_t n = 0; n < functional.size(); ++n) functional[n] |= in_lesion[n];
    }
    for (std::uint8_t& voxel : functional) voxel ^= 1U;
    const auto count = static_cast<std::size_t>(std::ranges::count(functional, 1));
    return OrganCase{std::move(tree), std::move(organ), claims, std::move(roles), std::move(functional),
                     count,           std::move(parts)};
}

Result<organ::Supply> supply_by(const OrganCase& read, const OrganFlags& flags,
                                const std::vector<std::uint8_t>& excluded) {
    return with_progress(
        "territories",
        [&](Job& job) {
            return organ::supply_of(read.organ, read.tree, flags.supply, excluded, JobRange(job, 0.0F, 1.0F));
        },
        kNothingWritten);
}

Result<SystemSupplies> supplies_by_system(const OrganCase& read, const OrganFlags& flags) {
    SystemSupplies systems;
    RAMUS_TRY(supplies, with_progress(
                            "territories",
                            [&](Job& job) {
                                return organ::supplies_by_system(read.organ, read.tree, flags.supply,
                                                                 JobRange(job, 0.0F, 1.0F));
                            },
                            kNothingWritten));
    systems.supplies = std::move(supplies);
    for (std::size_t s = 0; s < systems.supplies.size(); ++s) {
        systems.parts.push_back({read.roles[s], systems.supplies[s].branch, systems.supplies[s].at});
        if (systems.supplies[s].branch.empty())
            std::cerr << "ramus: no vessel of " << printable(name_of_system(read.tree, static_cast<int>(s)))
                      << " lies in the organ\n";
    }
    return systems;
}

std::string name_of_system(const tree::VesselTree& tree, int system) {
    return tree.systems.empty() ? std::string() : system_name(tree.systems, system);
}

Result<void> write_case_labels(const OrganCase& read, const std::vector<std::string>& names,
                               const std::function<std::uint16_t(std::size_t)>& label_of, const std::string& output) {
    return with_progress(
        "writing",
        [&](Job& job) {
            return write_organ_labels(parts_of(read.organ, read.claims, names), label_of, output,
                                      JobRange(job, 0.0F, 1.0F));
        },
        kNothingWritten);
}

void add_labels_option(CLI::App& command, const char* name, std::vector<volume::LabelChoice>& labels,
                       const char* help) {
    add_option_taking<std::string>(
        command, name, "LABEL,...", [&labels](const std::string& text) { labels = *label_list(text); }, help)
        ->check(expecting(" is not a list of names and whole numbers other than 0", label_list));
}

void add_organ_options(CLI::App& command, OrganFlags& flags) {
    add_input(command, "--organ", "MASK", flags.organ, "Mask of the organ: " + io::readable_volume_extensions())
        ->required();
    add_mask_units_flag(command, flags.mask_units, "the masks");
    add_labels_option(command, "--organ-label", flags.organ_labels,
                      "Labels of the mask that are the organ (default: all)");
    add_input(command, "--lesions", "MASK", flags.lesions,
              "Mask of lesions, which are not part of the functional organ");
    add_labels_option(command, "--lesion-label", flags.lesion_labels,
                      "Labels of that mask that are lesions (default: all)");
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

} // namespace ramus::app
