// Registers the files that this run has read, so that no output replaces one of them (OutputFile checks). A file is
// identified by device, inode and time of birth, so symbolic links, hard links and other spellings of its name count as
// the same file. Thread-safe.
//
// Code that opens a file which a user named must call note_input(), once for each file. Not registered: the program's
// own files (settings, recovery), pipes and devices.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace ramus::io {

// A session may be written over a session that was read: that is how sessions are saved.
enum class InputKind : std::uint8_t { kFile, kSession };

// Registers an input. A file that is registered as both kinds counts as kFile. Does nothing for a missing file.
void note_input(const std::filesystem::path& file, InputKind kind = InputKind::kFile);

// The input that an output of `kind` to `target` would overwrite, by the path that it was read from. None: no input.
[[nodiscard]] std::optional<std::filesystem::path> input_lost_by(const std::filesystem::path& target, InputKind kind);

// Removes a newly created file from the inputs: a deleted input may have had the same inode.
void forget_input(int descriptor);

// While such an object with keep = true exists, outputs may only replace files that this run has created: a commands
// file may come from somebody else. Applies to all threads of the process.
class KeepExistingFiles {
public:
    explicit KeepExistingFiles(bool keep);
    ~KeepExistingFiles();
    KeepExistingFiles(const KeepExistingFiles&) = delete;
    KeepExistingFiles& operator=(const KeepExistingFiles&) = delete;

private:
    bool keep_;
};
[[nodiscard]] bool keeps_existing_files();

// Whether `target` is a file that KeepExistingFiles protects.
[[nodiscard]] bool must_stay(const std::filesystem::path& target);
// Whether `target` is missing, no regular file, or created by this run. The caller that then replaces it must call
// note_made().
[[nodiscard]] bool is_ours_to_make(const std::filesystem::path& target);
void note_made(const std::filesystem::path& file);

} // namespace ramus::io
