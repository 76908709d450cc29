// `ramus ratings FILE...`: evaluates the answers on the rating pages of `ramus study`, as in the paper's Table II.
#include "app/commands/output_target.h"
#include "app/commands/subcommands.h"
#include "app/ratings/rating_results.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct RatingsFlags {
    std::vector<std::string> files;
    std::string csv;
    std::string paired_by = "rater";
    bool json = false;
};

Result<int> run_ratings(const RatingsFlags& flags) {
    const bool to_stream = is_standard_output(flags.csv);
    if (to_stream && flags.json) return fail("--csv - and --json both write to standard output", {}, "leave one out");
    if (!flags.csv.empty() && !to_stream)
        if (auto can = io::check_output(flags.csv); !can) return tl::unexpected(can.error());
    RAMUS_TRY(ratings, read_ratings(flags.files));
    const RatingResults results =
        results_of(ratings, flags.paired_by == "rater" ? measure::PairedBy::kRater : measure::PairedBy::kAnswer);
    if (to_stream) {
        std::cout << csv_lines(results_table(results));
        return kDone;
    }
    if (!flags.csv.empty())
        if (auto done = io::write_file(flags.csv, csv_of(results_table(results))); !done)
            return tl::unexpected(done.error());
    if (flags.json)
        std::cout << io::printed_json(results_json(results)) << '\n';
    else
        std::cout << results_text(results);
    return kDone;
}

} // namespace

void register_ratings(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<RatingsFlags>();
    CLI::App* command = add_command(
        app, "ratings", "Evaluate the answers of a study's raters: mean, sigma, significance of differences");
    add_option(*command, "FILE", "", flags->files, "key.json of the study, and the answers that its raters saved")
        ->required();
    add_option(*command, "--csv", "FILE", flags->csv,
               "Write the table as CSV, too; - for CSV alone on standard output");
    add_option(*command, "--pair-by", "rater|answer", flags->paired_by,
               "Pairs of the significance test: raters, by their means over scenes, or single answers (default: rater)")
        ->check(CLI::IsMember({"rater", "answer"}).description(""));
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    command->callback([flags, &chosen] { chosen = [flags] { return run_ratings(*flags); }; });
}

} // namespace ramus::app
