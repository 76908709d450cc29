// OutputTarget: the destination of a command's output, a file or with `-o -` standard output. Writers need a file that
// they can replace and seek in. So output for standard output is first written to a file in a temporary folder, and
// copied once it is complete. Guaranteed: a file is written completely or not at all. Not guaranteed for standard
// output: copying may fail midway.
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

// Whether `output` names standard output: "-" or /dev/stdout.
[[nodiscard]] bool is_standard_output(const std::filesystem::path& output);

// The name of an output in messages: its path, or "standard output".
[[nodiscard]] std::string output_name(const std::filesystem::path& file);

// The extensions of the tree and mesh formats that can be written to standard output. Not those of several files: CSV
// of trees, PVTP of meshes.
[[nodiscard]] std::vector<std::string_view> streamed_tree_extensions();
[[nodiscard]] std::vector<std::string_view> streamed_mesh_extensions();

// Adds --format, the format of standard output. `extensions`: of the formats that the command can write.
void add_format_flag(CLI::App& command, std::string& format, const std::vector<std::string_view>& extensions);

// Checks -o, --format and --json. Throws CLI::ValidationError if --format is given for a file, if it is missing for
// standard output, or if both -o and --json write to standard output.
void check_output_flags(const CLI::App& command, const std::filesystem::path& output, const std::string& format);

// Redirects std::cout to standard error during its lifetime.
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
    // `format`: an extension with or without its dot, used for standard output only. Fails if standard output is a
    // terminal, or if no temporary folder can be created.
    [[nodiscard]] static Result<OutputTarget> of(const std::filesystem::path& output, const std::string& format);

    // The file to write: the output itself, or a temporary file for standard output.
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool is_stream() const { return scratch_.has_value(); }
    // Copies the temporary file to standard output, if there is one. The temporary file is removed first, so none is
    // left if the reader closes the pipe.
    [[nodiscard]] Result<void> deliver();

private:
    std::filesystem::path file_;
    std::optional<ScratchFolder> scratch_;
};

// Runs a command that writes the file `flags.output`, which may name standard output. Flags without a `format` are
// written as PNG. If the output is standard output, other text of the command is printed on standard error.
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
