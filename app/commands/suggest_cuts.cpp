#include "app/commands/suggest_cuts.h"

#include "app/commands/command.h"
#include "app/commands/progress.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/base/words.h"
#include "core/io/text_numbers.h"
#include "core/organ/territories.h"

#include <algorithm>
#include <iostream>

namespace ramus::app {

namespace {

Result<int> system_to_cut(const OrganCase& read, const OrganFlags& flags) {
    std::vector<int> systems;
    for (const std::string& word : flags.reading.systems) {
        RAMUS_TRY(system, find_system(read.tree.systems, word));
        systems.push_back(static_cast<int>(system));
    }
    for (std::size_t s = 0; s < read.system_count() && flags.reading.systems.empty(); ++s)
        if (read.roles[s] == organ::Role::kSupplies) systems.push_back(static_cast<int>(s));
    if (systems.size() != 1)
        return fail(systems.empty() ? "the tree has no system that supplies"
                                    : "the tree has several systems whose vessels could be cut",
                    flags.tree, "name one with --system");
    return systems.front();
}

// "12@0.43", so that --group cuts= reads the same cut.
std::string word_of(const measure::Cut& cut) { return std::to_string(cut.first) + '@' + io::exact_number(cut.second); }

} // namespace

void add_cut_options(CLI::App& command, CutWish& wish) {
    auto* margin = add_option_taking<double>(
        command, "--fewest-cuts", "MM", [&wish](const double& mm) { wish.margin_mm = mm; },
        "Suggest the cuts that take the supply of --lesions and of all within this margin, with the least loss, for "
        "each number of cuts");
    margin->check(CLI::Range(0.0, 1e6))->needs(command.get_option("--lesions"));
    add_option(command, "--most-cuts", "N", wish.most_cuts, "The largest number of cuts to suggest (default 6)")
        ->check(CLI::Range(1, 50))
        ->needs(margin);
}

Result<CutAnswer> suggest_cuts(const OrganCase& read, const OrganFlags& flags, const CutWish& wish) {
    CutAnswer answer;
    answer.margin_mm = wish.margin_mm.value_or(0.0);
    RAMUS_TRY(system, system_to_cut(read, flags));
    answer.system = system;
    RAMUS_TRY(lesions, load_organ(flags.lesions, flags.lesion_labels, mask_flags(flags)));
    RAMUS_TRY(targets, with_progress(
                           "margin",
                           [&](Job& job) -> Result<std::vector<std::uint8_t>> {
                               auto near =
                                   organ::voxels_near(read.organ, lesions, answer.margin_mm, JobRange(job, 0.0F, 1.0F));
                               if (near.empty()) return fail("cancelled");
                               return near;
                           },
                           kNothingWritten));
    answer.targets = read.organ.count() - static_cast<std::size_t>(std::ranges::count(targets, 0));
    if (answer.targets == 0)
        return fail("no lesion is in the organ or near it", flags.lesions, "check that both masks are of one patient");
    RAMUS_TRY(supply, supply_by(read, flags, organ::all_but_system(read.tree, static_cast<std::size_t>(system))));
    answer.suggestions =
        organ::fewest_cuts(tree::Dependency(read.tree), supply, targets, read.functional, wish.most_cuts);
    return answer;
}

nlohmann::ordered_json json_of(const OrganCase& read, const CutAnswer& answer) {
    const auto ml = [&](std::size_t voxels) { return static_cast<double>(voxels) * read.organ.voxel_ml(); };
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const organ::SuggestedCuts& one : answer.suggestions.by_number) {
        nlohmann::ordered_json cuts = nlohmann::ordered_json::array();
        for (const measure::Cut& cut : one.cuts) cuts.push_back(word_of(cut));
        all.push_back(
            {{"cuts", cuts},
             {"lost_ml", ml(one.lost)},
             {"lost_percent", 100.0 * double(one.lost) / double(std::max<std::size_t>(read.functional_voxels, 1))},
             {"covered_ml", ml(answer.suggestions.covered)}});
    }
    return {{"system", name_of_system(read.tree, answer.system)},
            {"margin_mm", answer.margin_mm},
            {"target_ml", ml(answer.targets)},
            {"out_of_reach_ml", ml(answer.suggestions.out_of_reach)},
            {"suggestions", all}};
}

void print_cuts(const OrganCase& read, const CutAnswer& answer) {
    const Lengths lengths(read.claims);
    const auto volume = [&](std::size_t voxels) {
        return lengths.volume(1000.0 * static_cast<double>(voxels) * read.organ.voxel_ml());
    };
    std::cout << "lesions and margin " << volume(answer.targets) << '\n';
    if (answer.suggestions.out_of_reach > 0)
        std::cout << "reached on two ways, so that no single cut takes the supply away: "
                  << volume(answer.suggestions.out_of_reach) << '\n';
    for (const organ::SuggestedCuts& one : answer.suggestions.by_number)
        std::cout << (one.cuts.size() == 1 ? "cut " : "cuts ") << joined(one.cuts, ",", word_of) << ": "
                  << volume(one.lost) << " lost, "
                  << rounded(100.0 * double(one.lost) / double(std::max<std::size_t>(read.functional_voxels, 1)))
                  << " % of the functional organ\n";
}

} // namespace ramus::app
