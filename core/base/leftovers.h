// What nobody wants once its owner is gone, however that one ends: unfinished files, folders for a while. An object
// goes with its scope; where a signal ends the process there is no such end, and end_by_signal() sees to it.
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
    Leftover() = default; // none
    Leftover(const std::filesystem::path& path, LeftoverKind what);
    Leftover(Leftover&& other) noexcept;
    Leftover& operator=(Leftover&& other) noexcept;
    ~Leftover(); // removes it

    void keep();                                                              // it is none any more
    [[nodiscard]] const std::filesystem::path& path() const { return path_; } // empty: none

private:
    void remove();

    std::filesystem::path path_;
    std::size_t number_ = 0;
    LeftoverKind what_ = LeftoverKind::kFile;
};

// While it lives end_by_signal() waits: for steps that belong together, as making a file and making it a Leftover.
[[nodiscard]] std::unique_lock<std::recursive_mutex> hold_leftovers();

// Removes every Leftover of this process, the youngest first, and ends it by the signal, as a shell expects of what is
// interrupted. Not for signal handlers.
[[noreturn]] void end_by_signal(int number);

} // namespace ramus
