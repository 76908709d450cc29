#include "app/commands/cohort_run.h"

#include "app/commands/progress.h"
#include "app/storage/opening_files.h"
#include "core/base/child_program.h"
#include "core/base/words.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <utility>

namespace ramus::app {

namespace {

namespace fs = std::filesystem;

constexpr std::array kStepRecords{"skeletonize.json", "measure.json", "validate.json", "picture.json"};
constexpr const char* kGoOn = "the same command goes on where this run ended; what snakemake said is in ";

// The share in a line of snakemake such as "12 of 300 steps (4%) done". None: another line.
std::optional<float> share_in(std::string_view line) {
    const std::size_t of = line.find(" of "), steps = line.find(" steps (");
    if (of == std::string_view::npos || steps == std::string_view::npos || steps < of) return {};
    constexpr std::size_t kOf = 4; // letters of " of "
    const auto done = parsed<float>(line.substr(0, of)), all = parsed<float>(line.substr(of + kOf, steps - of - kOf));
    return done && all && *all > 0.0F ? std::optional(*done / *all) : std::nullopt;
}

// Recognises what snakemake and run.py say of a failure. A heading such as "WorkflowError:" goes with the line after
// it.
class Complaints {
public:
    bool has(std::string_view line) {
        const bool is_one = after_heading_ || line.find("Error") != std::string_view::npos ||
                            line.find("another run") != std::string_view::npos || line.starts_with("snakemake: error");
        after_heading_ = is_one && line.ends_with(':');
        return is_one;
    }

private:
    bool after_heading_ = false;
};

// The program that starts the workflow, workflow/scripts/run.py, with its arguments.
Result<std::vector<std::string>> workflow_words(const WorkflowCall& call) {
    const std::optional<fs::path> folder = workflow_folder();
    if (!folder) return fail("the workflow is missing", "share/ramus/workflow", "install ramus again");
    const std::string snakefile = (*folder / "Snakefile").string(), out = call.out.string();
    if (find_program("snakemake").empty())
        return fail("snakemake is not installed, which runs a cohort", {},
                    "install it (Debian: apt install snakemake python3-matplotlib) and repeat the command; or run it "
                    "where it is installed: snakemake --snakefile '" +
                        snakefile + "' --directory '" + out + "' --cores 4 --keep-going --rerun-incomplete");
    if (find_program("python3").empty()) return fail("python3 is not installed", {}, "install it");
    std::vector<std::string> words{"python3", (*folder / "scripts" / "run.py").string(), out};
    words.insert(words.end(), call.options.begin(), call.options.end());
    return words;
}

} // namespace

Result<CohortLock> CohortLock::take(const fs::path& out) {
    const fs::path file = out / ".lock";
    // Programs that this one starts inherit the descriptor: no O_CLOEXEC.
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT, 0666);
    if (descriptor < 0)
        return fail(std::string("the folder cannot be written: ") + std::strerror(errno), out.string(),
                    "check its permissions, or name another one");
    CohortLock lock(descriptor);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        return fail("another run works in this folder", out.string(), "wait until it has ended, or end it");
    return lock;
}

std::string CohortLock::variable() const { return "RAMUS_COHORT_LOCK=" + std::to_string(descriptor_->number()); }

nlohmann::ordered_json json_of_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return nullptr;
    auto value = nlohmann::ordered_json::parse(stream, nullptr, false);
    return value.is_discarded() ? nlohmann::ordered_json(nullptr) : value;
}

std::size_t forget_failures(const fs::path& out, bool all) {
    const nlohmann::ordered_json outcome = json_of_file(out / "tables" / "outcome.json");
    if (!outcome.is_object() || !outcome.contains("failed")) return 0;
    std::size_t count = 0;
    for (const auto& one : outcome["failed"]) {
        if (!all && one.value("state", "") != "killed") continue;
        ++count;
        for (const char* record : kStepRecords) {
            std::error_code ignored;
            fs::remove(out / "cases" / one.value("folder", "") / record, ignored);
        }
    }
    return count;
}

Result<void> run_workflow(const WorkflowCall& call, const std::function<void(std::string_view)>& hear) {
    RAMUS_TRY(words, workflow_words(call));
    auto done = with_progress("steps of the cohort", [&](Job& job) -> Result<void> {
        RAMUS_TRY(program, ChildProgram::start(words, call.environment));
        Complaints complaints;
        return program.wait(job, [&](std::string_view line) {
            if (hear) hear(line);
            if (const auto share = share_in(line)) job.report(*share);
            return !complaints.has(line);
        });
    });
    if (done) return done;
    Error error = done.error();
    error.where = call.out.string();
    error.hint = kGoOn + (call.out / ".snakemake" / "log").string();
    return tl::unexpected(std::move(error));
}

} // namespace ramus::app
