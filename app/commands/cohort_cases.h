// Finds the cases of a cohort below a folder: every vessel tree and every mask in a format that ramus reads. Files that
// are no case are listed with the reason. Nothing is written.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ramus::app {

enum class CaseKind : std::uint8_t { kTree, kMask };

// A file that a case is read from.
struct CaseFile {
    std::string path; // below the folder of the cohort
    std::uint64_t bytes = 0;
    std::int64_t modified = 0; // as the file system counts it
    std::string sha256;        // of its bytes; core/io/checksum.h
};

struct CohortCase {
    std::string name;   // path below the folder of the cohort, without extension; unique
    std::string folder; // the name as one word of letters, digits, dots, dashes and underscores; unique
    CaseKind kind = CaseKind::kTree;
    std::vector<CaseFile> files; // the one to read first
    std::string sha256;          // of all files together
};

struct SkippedFile {
    std::string path, reason;
};

struct FoundCases {
    std::vector<CohortCase> cases; // by name
    std::vector<SkippedFile> skipped;
};

// `earlier`: the configuration of an earlier run, or null. Files with the size and date that are recorded there keep
// the recorded checksum and are not read. Fails if the folder cannot be read, if it has no case, or if two files would
// be the same case.
[[nodiscard]] Result<FoundCases> find_cases(const std::filesystem::path& root, const nlohmann::ordered_json& earlier,
                                            Job& job);

// The members name, folder, relative, file, kind, sha256 and files, as workflow/scripts read them.
[[nodiscard]] nlohmann::ordered_json case_json(const CohortCase& one, const std::filesystem::path& root);

} // namespace ramus::app
