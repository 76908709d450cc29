// Where a command writes what -o names: a file, or with `-o -` standard output. What goes there is first written to a
// folder of its own in TMPDIR, for writers replace files and some go back to their beginning; so standard output gets
// nothing before all of it is there. It may then stop anywhere: only files are whole or not there.
#pragma once

#include "core/base/error.h"
#include "core/base/scratch_folder.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// Whether the output is standard output, "-" or /dev/stdout.
[[nodiscard]] bool is_standard_output(const std::filesystem::path& output);

// What people call an output: its path, or "standard output".
[[nodiscard]] std::string output_name(const std::filesystem::path& file);

// Extensions of the tree formats of one file, which can go to standard output: not the pair of CSV files.
[[nodiscard]] std::vector<std::string_view> streamed_tree_extensions();

// --format, which says in which format standard output is; `extensions`: of the formats that there are.
void add_format_flag(CLI::App& command, std::string& format, const std::vector<std::string_view>& extensions);

// Throws CLI::ValidationError where -o and --format do not go together, and where --json of the command asks for
// another text on the same standard output.
void check_output_flags(const CLI::App& command, const std::filesystem::path& output, const std::string& format);

// While it lives, what is said on std::cout goes to standard error.
class SentencesToStandardError {
public:
    SentencesToStandardError();
    ~SentencesToStandardError();
    SentencesToStandardError(const SentencesToStandardError&) = delete;
    SentencesToStandardError& operator=(const SentencesToStandardError&) = delete;

private:
    std::streambuf* before_;
};

class OutputTarget {
public:
    // `format`: an extension with or without its dot; of standard output alone.
    [[nodiscard]] static Result<OutputTarget> of(const std::filesystem::path& output, const std::string& format);

    // What is to be written; of standard output one that has no other use.
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool is_stream() const { return scratch_.has_value(); }
    // Sends what was written to standard output, if that is wanted. Leaves no file behind, also if nobody reads on.
    [[nodiscard]] Result<void> deliver();

private:
    std::filesystem::path file_;
    std::optional<ScratchFolder> scratch_;
};

// Runs a command that writes `flags.output`, in the format `flags.format`. While that goes to standard output, all that
// the command says goes to standard error.
template <class Flags> Result<int> with_output(Flags flags, Result<int> (*run)(const Flags&)) {
    std::string format;
    if constexpr (requires { flags.format; })
        format = flags.format;
    else
        format = ".png";
    RAMUS_TRY(target, OutputTarget::of(flags.output, format));
    flags.output = target.file().string();
    std::optional<SentencesToStandardError> aside;
    if (target.is_stream()) aside.emplace();
    RAMUS_TRY(status, run(flags));
    if (auto delivered = target.deliver(); !delivered) return tl::unexpected(delivered.error());
    return status;
}

} // namespace ramus::app
