// The folder of a cohort: its lock, its configuration, the records of failed cases, and the workflow that runs in it.
// workflow/README.md describes the files.
#pragma once

#include "core/base/descriptor.h"
#include "core/base/error.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ramus::app {

// Holds the folder while it exists; programs that this process starts hold it, too, until they end. So a run that
// outlives a killed ramus keeps the folder locked.
class CohortLock {
public:
    // Creates OUT/.lock. Fails if another run holds the folder.
    [[nodiscard]] static Result<CohortLock> take(const std::filesystem::path& out);
    [[nodiscard]] std::string variable() const; // "NAME=value" of the environment, which tells run.py of the lock

private:
    explicit CohortLock(int descriptor) : descriptor_(std::make_unique<Descriptor>(descriptor)) {}
    std::unique_ptr<Descriptor> descriptor_;
};

// The JSON of a file. Null if there is none, or if it cannot be parsed.
[[nodiscard]] nlohmann::ordered_json json_of_file(const std::filesystem::path& file);

// Removes the records of cases that failed in the last run, so that their steps run again: of those that a signal
// ended, and with `all` of every failed case. Returns how many cases.
std::size_t forget_failures(const std::filesystem::path& out, bool all);

struct WorkflowCall {
    std::filesystem::path out;
    std::vector<std::string> options;       // of snakemake
    std::vector<std::string> environment{}; // CohortLock::variable()
};

// Runs the workflow with a progress bar. `hear` gets each line of snakemake. Fails if snakemake, Python or the files of
// the workflow are missing, with what to install; if snakemake fails; and if an interrupt ends it.
[[nodiscard]] Result<void> run_workflow(const WorkflowCall& call,
                                        const std::function<void(std::string_view)>& hear = {});

} // namespace ramus::app
