// Leftover: a file or folder on disk that is removed when its owner ends: an unfinished file, a scratch folder. The
// destructor removes it. When a signal ends the process, no destructor runs, and end_by_signal() removes all of them.
// Not guaranteed: removal after a crash, SIGKILL, or where the system refuses it (errors are ignored).
#pragma once

#include <filesystem>
#include <mutex>

namespace ramus {

enum class LeftoverKind {
    kFile,        // a file, or a folder if there is nothing in it
    kWholeFolder, // a folder with all that is in it
};

class Leftover {
public:
    Leftover() = default; // owns nothing
    Leftover(const std::filesystem::path& path, LeftoverKind what);
    Leftover(Leftover&& other) noexcept;
    Leftover& operator=(Leftover&& other) noexcept;
    ~Leftover(); // removes it from the disk

    void keep();                                                              // gives up ownership; it stays on disk
    [[nodiscard]] const std::filesystem::path& path() const { return path_; } // absolute; empty: owns nothing

private:
    void remove();

    std::filesystem::path path_;
    std::size_t number_ = 0;
    LeftoverKind what_ = LeftoverKind::kFile;
};

// Locks the list of leftovers. end_by_signal() waits for the lock, so steps under it are not interrupted: for example
// creating a file and making it a Leftover.
[[nodiscard]] std::unique_lock<std::recursive_mutex> hold_leftovers();

// Removes every Leftover of this process, the youngest first, and ends the process by the signal, as a shell expects of
// an interrupted program. Must not be called from a signal handler.
[[noreturn]] void end_by_signal(int number);

} // namespace ramus
