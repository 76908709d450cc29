// `ramus cohort FOLDER -o OUT`: measures, validates and draws every vessel tree and mask below a folder, and joins the
// results in tables and a page. The work is a Snakemake workflow (workflow/README.md), which this command configures
// and starts.
#include "app/commands/cohort_cases.h"
#include "app/commands/cohort_options.h"
#include "app/commands/cohort_run.h"
#include "app/commands/listing.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/picture/figure_options.h"
#include "app/session/numbers.h"
#include "app/storage/opening_files.h"
#include "core/base/memory.h"
#include "core/base/printable.h"
#include "core/base/scratch_folder.h"
#include "core/base/words.h"
#include "core/io/output_file.h"
#include "core/io/output_folder.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace ramus::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct CohortFlags {
    SurfaceFlags surface;
    fs::path folder, output;
    unsigned cores = 0; // 0: not given
    std::string profile, size = "800x600";
    std::vector<std::string> snakemake; // further options
    bool dry_run = false, retry = false, json = false;
    Json given, options; // of the command line, and for each step

    [[nodiscard]] unsigned cores_used() const {
        return cores > 0 ? cores : std::max(1U, std::thread::hardware_concurrency());
    }
    [[nodiscard]] unsigned threads() const { // of a step
        return static_cast<unsigned>(std::max(1, surface.surface.threads));
    }
};

// Absolute, without symbolic links, also if it does not exist yet.
fs::path whole_path(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(path), error);
    return error ? fs::absolute(path) : whole;
}

bool is_within(const fs::path& path, const fs::path& folder) {
    const auto [end, other] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() || (std::next(end) == folder.end() && end->empty());
}

Result<void> check_cohort_folders(const CohortFlags& flags) {
    std::error_code error;
    if (!fs::is_directory(flags.folder, error))
        return fail("this is no folder", flags.folder.string(), "name the folder with the trees and masks");
    for (const fs::path& path : {flags.folder, flags.output})
        if (printable(path.string()) != path.string())
            return fail("the name has control characters or is not UTF-8", path.string(), "rename the folder");
    if (is_within(flags.output, flags.folder))
        return fail("the output is in the folder of the cases, which is only read", flags.output.string(),
                    "name a folder elsewhere");
    return {};
}

// Cases run side by side on one machine, and share the half of its memory that a command may use.
std::uint64_t memory_of_a_case(const CohortFlags& flags) {
    const std::uint64_t asked = flags.surface.surface.memory_bytes;
    if (asked > 0 || !flags.profile.empty()) return asked;
    const unsigned at_once = std::max(1U, flags.cores_used() / flags.threads());
    return static_cast<std::uint64_t>(memory_limit(0.0) / at_once);
}

Json skipped_json(const std::vector<SkippedFile>& skipped) {
    Json list = Json::array();
    for (const SkippedFile& one : skipped) list.push_back({{"path", printable(one.path)}, {"reason", one.reason}});
    return list;
}

Result<Json> configuration(const CohortFlags& flags, const FoundCases& found) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return fail("the program's own file is not known: " + error.message());
    Json config{{"version", RAMUS_VERSION},
                {"program", program.string()},
                {"root", flags.folder.string()},
                {"given", flags.given},
                {"options", flags.options},
                {"compares_masks", compares_masks(flags.given)},
                {"size", flags.size},
                {"threads", flags.threads()},
                {"memory_bytes", memory_of_a_case(flags)},
                {"cases", Json::array()},
                {"skipped", skipped_json(found.skipped)}};
    for (const CohortCase& one : found.cases) config["cases"].push_back(case_json(one, flags.folder));
    return config;
}

Result<std::vector<std::string>> snakemake_options(const CohortFlags& flags) {
    std::vector<std::string> words{
        "--keep-going", "--rerun-incomplete", "--scheduler", "greedy", "--rerun-triggers", "mtime", "params"};
    if (flags.profile.empty() || flags.cores > 0)
        words.insert(words.end(), {"--cores", std::to_string(flags.cores_used())});
    if (!flags.profile.empty()) {
        const std::optional<fs::path> workflow = workflow_folder();
        fs::path profile = flags.profile;
        if (flags.profile.find('/') == std::string::npos && workflow) profile = *workflow / "profiles" / flags.profile;
        std::error_code error;
        if (!fs::is_regular_file(profile / "config.yaml", error))
            return fail("there is no config.yaml of a profile in it", profile.string(),
                        "name slurm, local, or the path of a folder with a profile of snakemake");
        words.insert(words.end(), {"--profile", fs::absolute(profile).string()});
    }
    words.insert(words.end(), flags.snakemake.begin(), flags.snakemake.end());
    return words;
}

void print_skipped(const std::vector<SkippedFile>& skipped) {
    for (std::size_t n = 0; n < std::min(skipped.size(), kMostListed); ++n)
        std::cout << "skipped " << printable(skipped[n].path) << ": " << skipped[n].reason << '\n';
    if (skipped.size() > kMostListed)
        std::cout << "and " << grouped(skipped.size() - kMostListed) << " more, listed in config.json\n";
}

// What would run. Writes nothing but snakemake's own notes in a folder that it already knows.
Result<int> plan_cohort(const CohortFlags& flags, const FoundCases& found) {
    RAMUS_TRY(config, configuration(flags, found));
    RAMUS_TRY(options, snakemake_options(flags));
    std::error_code error;
    std::optional<std::uint64_t> steps; // to run; none: all
    if (fs::is_directory(flags.output / ".snakemake", error)) {
        RAMUS_TRY(scratch, ScratchFolder::create());
        const fs::path file = scratch.path() / "config.json";
        if (auto written = io::write_file(file, config.dump()); !written) return tl::unexpected(written.error());
        for (const std::string& word : {std::string("--dry-run"), std::string("--quiet"), std::string("--nolock"),
                                        std::string("--configfile"), file.string()})
            options.push_back(word);
        steps = 0;
        const auto hear = [&steps](std::string_view line) {
            if (!line.starts_with("total")) return;
            line.remove_prefix(std::min(line.find_first_of("0123456789"), line.size()));
            steps = parsed<std::uint64_t>(line.substr(0, line.find(' ')));
        };
        if (auto planned = run_workflow({flags.output, options}, hear); !planned)
            return tl::unexpected(planned.error());
    }
    if (flags.json) {
        Json report{{"cases", Json::array()}, {"skipped", skipped_json(found.skipped)}, {"steps", nullptr}};
        for (const CohortCase& one : found.cases)
            report["cases"].push_back({{"name", one.name}, {"file", one.files.front().path}});
        if (steps) report["steps"] = *steps;
        std::cout << report.dump(2) << '\n';
        return kDone;
    }
    for (const CohortCase& one : found.cases)
        std::cout << (one.kind == CaseKind::kMask ? "mask " : "tree ") << one.files.front().path << '\n';
    print_skipped(found.skipped);
    std::cout << counted(found.cases.size(), "case", "cases") << "; "
              << (steps ? counted(*steps, "step", "steps") + " to run" : "all to run") << '\n';
    return kDone;
}

Result<int> report_cohort(const CohortFlags& flags, const FoundCases& found) {
    const Json outcome = json_of_file(flags.output / "tables" / "outcome.json");
    if (!outcome.is_object())
        return fail("the workflow has not written its tables", flags.output.string(), "see .snakemake/log there");
    const Json& failed = outcome.at("failed");
    for (const Json& one : failed)
        std::cerr << "ramus: " << printable(one.at("case").get<std::string>()) << ": "
                  << printable(one.at("message").get<std::string>()) << '\n';
    const fs::path page = flags.output / "index.html";
    if (flags.json) {
        const Json report{{"cases", outcome.at("cases")},
                          {"done", outcome.at("done")},
                          {"failed", failed},
                          {"skipped", skipped_json(found.skipped)},
                          {"page", page.string()},
                          {"tables", (flags.output / "tables").string()}};
        std::cout << report.dump(2) << '\n';
    } else {
        print_skipped(found.skipped);
        std::cout << grouped(outcome.at("done")) << " of " << counted(outcome.at("cases"), "case", "cases")
                  << " complete; summary: " << page.string() << '\n';
    }
    return failed.empty() ? kDone : kFailed;
}

Result<int> run_cohort(CohortFlags flags) {
    flags.folder = whole_path(flags.folder);
    flags.output = whole_path(flags.output);
    if (auto good = check_cohort_folders(flags); !good) return tl::unexpected(good.error());
    const Json earlier = json_of_file(flags.output / "config.json");
    RAMUS_TRY(found, with_progress("checksums", [&](Job& job) { return find_cases(flags.folder, earlier, job); }));
    if (flags.dry_run) return plan_cohort(flags, found);
    RAMUS_TRY(config, configuration(flags, found));
    RAMUS_TRY(options, snakemake_options(flags));
    RAMUS_TRY(folder, io::OutputFolder::make(flags.output));
    RAMUS_TRY(lock, CohortLock::take(folder.path()));
    if (auto written = io::write_file(flags.output / "config.json", config.dump(1) + "\n"); !written)
        return tl::unexpected(written.error());
    forget_failures(flags.output, flags.retry);
    if (auto done = run_workflow({flags.output, options, {lock.variable()}}); !done)
        return tl::unexpected(done.error());
    return report_cohort(flags, found);
}

} // namespace

void register_cohort(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<CohortFlags>();
    CLI::App* command = add_command(
        app, "cohort", "Measure, validate and draw all trees and masks of a folder, with tables and a page");
    add_option(*command, "FOLDER", "", flags->folder, "Folder with vessel trees and masks, also in folders below it")
        ->required();
    add_option(*command, "-o,--output", "OUT", flags->output,
               "Folder for results; not in FOLDER. A run that was ended goes on where it was")
        ->required();
    add_option(*command, "--cores", "N", flags->cores, "Cores to use (default: all)")->check(CLI::Range(1, 4096));
    add_option(*command, "--profile", "NAME|PATH", flags->profile,
               "Profile of snakemake: slurm sends the cases to a cluster; local; or a folder with another one");
    command
        ->add_option("--option", flags->snakemake,
                     "Further word for snakemake, as --option=--printshellcmds; may be repeated")
        ->type_name("WORD")
        ->allow_extra_args(false);
    add_option(*command, "--size", "WxH", flags->size, "Pixels of the pictures (default 800x600)")
        ->check(expecting(" is not a size like 800x600", [](const std::string& word) {
            constexpr int kLeast = 64;
            const auto size = size_in(word);
            return size && size->x >= kLeast && size->y >= kLeast;
        }));
    command->add_flag("--dry-run", flags->dry_run, "Say what would be done, and do nothing");
    command->add_flag("--retry", flags->retry, "Compute cases again that failed");
    command->add_flag("--json", flags->json, "Print one JSON object");
    add_cohort_surface_flags(*command, flags->surface);
    command->footer(
        "A case that fails is named and stops no other; the exit status is then 1. A case is computed again "
        "when its file or the options change.");
    command->callback([flags, command, &app, &chosen] {
        flags->given = given_options(*command, flags->surface);
        flags->options = step_options(app, flags->given);
        chosen = [flags] { return run_cohort(*flags); };
    });
}

} // namespace ramus::app
