// The files that this run has read, so that nothing it writes replaces one of them: OutputFile asks here. A file is
// known by device, inode and time of birth, so that a link, another spelling of its name and a hard link are the same
// file. May be called from any thread.
//
// Who opens a file that a user named says so, once for each file, or once for a whole folder of images. The program's
// own files (settings, recovery) are not among them. Pipes and devices are nobody's to lose.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace ramus::io {

// What may be written over an input. A session may be saved over a session: that is what saving means.
enum class InputKind : std::uint8_t { kFile, kSession };

// A file that is noted as both is a file. Does nothing for what is not there, and for no name.
void note_input(const std::filesystem::path& file, InputKind kind = InputKind::kFile);

// As which file `target` was read, if writing it would lose what was read. `kind`: of what is written.
[[nodiscard]] std::optional<std::filesystem::path> input_lost_by(const std::filesystem::path& target, InputKind kind);

// For a file that was just made: an older one that is gone may have had its number.
void forget_input(int descriptor);

// While one lives, no output replaces a file that this run has not made itself: commands may come from somebody else.
// Of the whole process: what another thread writes meanwhile counts as well.
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

// Whether `target` is a file that must stay as it is now.
[[nodiscard]] bool must_stay(const std::filesystem::path& target);
// Whether `target` is missing, or was made by this run: what comes to its place is then noted by note_made().
[[nodiscard]] bool is_ours_to_make(const std::filesystem::path& target);
void note_made(const std::filesystem::path& file);

} // namespace ramus::io
