// OutputFile: the only way in which ramus writes output files. The bytes go to a file without a name in the folder of
// the target (or to a temporary name, where the file system needs one), and reach the disk before the file is renamed
// over the target.
//
// Guaranteed: the target is never half written. If anything fails, or a signal ends the process
// (core/base/leftovers.h), an existing target stays as it was and nothing else is left behind. A file that this run has
// read is never replaced, except a session by a session (run_inputs.h).
//
// Not guaranteed: the same for devices and pipes (/dev/stdout), which are written directly.
//
//     RAMUS_TRY(file, OutputFile::create(target));
//     file.write(text);
//     return file.commit(); // reports the first error of any write
#pragma once

#include "core/base/descriptor.h"
#include "core/io/buffered_file.h"
#include "core/io/run_inputs.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace ramus::io {

// Checks before long work whether `target` can be written. Fails if its folder is missing or not writable, or if it is
// a folder, a file that this run has read, or a file that must stay (run_inputs.h). `kind`: of the output.
[[nodiscard]] Result<void> check_output(const std::filesystem::path& target, InputKind kind = InputKind::kFile);

class OutputFile : public BufferedFile {
public:
    [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& target,
                                                   InputKind kind = InputKind::kFile);

    OutputFile(OutputFile&&) noexcept;
    ~OutputFile(); // discards the file if commit() was not called

    // Renames the file over its target. Fails with the first error of any write; the file is then discarded.
    [[nodiscard]] Result<void> commit();

private:
    friend Result<void> commit_both(OutputFile& first, OutputFile& second);
    friend Result<void> commit_all(std::span<OutputFile> files);
    friend class OutputSet;
    struct State;
    void finish(); // writes all to the disk and closes; does not rename yet
    [[nodiscard]] Result<void> put_in_place();
    OutputFile(int descriptor, std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

// Commits two files that are useless without each other: both or none. If one fails, existing targets stay as they
// were. Exceptions: the machine stops between the two renamings, or the file system cannot exchange names; then the
// first target can be replaced or removed although the second failed.
[[nodiscard]] Result<void> commit_both(OutputFile& first, OutputFile& second);

// Commits files that belong together, in order: no file is renamed before all are completely on the disk. If a renaming
// then fails, the files before it are new and the others old.
[[nodiscard]] Result<void> commit_all(std::span<OutputFile> files);

// OutputSet: files that belong together and are produced one after the other, such as the pictures of a turntable. They
// are collected in one file without a name, of which nothing is left if the process is killed, and written by commit().
class OutputSet {
public:
    [[nodiscard]] Result<void> add(const std::filesystem::path& target, std::string_view text);
    [[nodiscard]] Result<void> commit();

private:
    struct One {
        std::filesystem::path target;
        std::uint64_t bytes = 0;
    };
    Descriptor kept_{-1};
    std::vector<One> files_;
};

// Creates, writes and commits a file.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& target, std::string_view text,
                                      InputKind kind = InputKind::kFile);

// The same with the bytes of a file that another program has made.
[[nodiscard]] Result<void> write_copy(const std::filesystem::path& made, const std::filesystem::path& target);

} // namespace ramus::io
