// DiskPages: memory for arrays larger than what the process may take, in files without a name.
//
// The bytes are mapped from the disk of a given file. A thread watches the resident memory of the process; near a limit
// it drops all mapped pages. They keep their content, and return when something uses them again: from the system's
// cache, or from the disk where the machine needs its memory otherwise. Dropping is safe while other threads read and
// write. Guaranteed: disk space is reserved before it is used, so that a full disk is an error and never a signal, and
// nothing is left behind, however the program ends. Not guaranteed: the limit, where other memory of the process comes
// near it, or where many cores bring back in a few milliseconds what is between.
//
//     const auto pages = std::make_shared<DiskPages>("liver.stl", 0.8e9);
//     LargeArray<float> radii(1'000'000'000, LargeAllocator<float>(pages)); // core/base/large_array.h
#pragma once

#include "core/base/large_array.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

namespace ramus {

class DiskPages final : public ArrayMemory {
public:
    // `target`: the file that the bytes will end in. A device has no disk: then $TMPDIR, or /var/tmp. No file is made
    // before the first allocation.
    DiskPages(std::filesystem::path target, double most_bytes);

    // All bytes 0. Throws a std::runtime_error, an Error's message, where the disk has no space or no file can be made.
    [[nodiscard]] void* allocate(std::size_t bytes) override;
    void deallocate(void* memory) noexcept override;
    // Drops all mapped pages from resident memory, and lets the system read ahead. To be called once the arrays are
    // written, before they are read.
    void release_resident() const;

private:
    void drop() const; // under the mutex
    void watch(const std::stop_token& stop) const;
    [[noreturn]] void refuse(std::size_t bytes, int code) const;

    std::filesystem::path target_, folder_;
    double most_bytes_;
    mutable std::mutex mutex_;
    std::map<void*, std::size_t> mapped_; // bytes, by address
    std::jthread watcher_;                // ends before the others do
};

} // namespace ramus
