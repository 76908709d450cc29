// The one way an output reaches the disk: written beside its target without a name, or under another one where the file
// system wants that, every write checked, flushed to the disk, and only then renamed over the target. Whatever fails,
// an older target stays as it was and nothing else is left behind, also where a signal ends the process
// (core/base/leftovers.h). Devices and pipes (/dev/stdout) are written as they are, for there is nothing to rename. A
// file that this run has read is never replaced, but for a session by a session (run_inputs.h).
//
// Failures on the way (a full disk, `ulimit -f`) are told by commit().
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

// Can a file be made there? Asked before long work starts: fails when the folder is missing or not writable, when
// `target` is a folder itself, a file that this run has read so far, or one that must stay (run_inputs.h). `kind`: of
// what is written.
[[nodiscard]] Result<void> check_output(const std::filesystem::path& target, InputKind kind = InputKind::kFile);

class OutputFile : public BufferedFile {
public:
    [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& target,
                                                   InputKind kind = InputKind::kFile);

    OutputFile(OutputFile&&) noexcept;
    ~OutputFile(); // without commit(): as if nothing had been written

    // Puts the file in its place. The first error of any write is told here; the file is then gone.
    [[nodiscard]] Result<void> commit();

private:
    friend Result<void> commit_both(OutputFile& first, OutputFile& second);
    friend Result<void> commit_all(std::span<OutputFile> files);
    friend class OutputSet;
    struct State;
    void finish(); // all but its name; once
    [[nodiscard]] Result<void> put_in_place();
    OutputFile(int descriptor, std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

// Two files that are worth nothing without each other: both come to their places, or none does, and older ones stay as
// they were. Only a machine that stops between two renamings leaves the first alone.
[[nodiscard]] Result<void> commit_both(OutputFile& first, OutputFile& second);

// Files that belong together: none comes to its place before all of them are whole on the disk, the last one last. Only
// a renaming that fails after that leaves some new beside old ones.
[[nodiscard]] Result<void> commit_all(std::span<OutputFile> files);

// Files that belong together and come one after the other, as pictures of a turn: they are kept in one file without a
// name, so that nothing is left of a process that is killed, and come to their places with commit().
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

// A whole file at once.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& target, std::string_view text,
                                      InputKind kind = InputKind::kFile);

} // namespace ramus::io
