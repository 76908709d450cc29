// DiskPages: memory for arrays that are larger than the process may take, in mapped files without a name.
//
// A thread watches the resident memory of the process. Near the limit it drops all mapped pages, and returns memory
// that allocators keep unused. Dropped pages keep their content; the next access maps them again, from the system's
// cache or from the disk. Dropping is safe while other threads read and write.
//
// Guaranteed: disk space is reserved before it is used, so a full disk is an error and never a signal. Nothing is left
// behind, however the program ends.
// Not guaranteed: the limit. Other memory of the process may come near it, and many cores may map more pages within a
// few milliseconds than the limit leaves.
//
//     const auto pages = std::make_shared<DiskPages>("liver.stl", 0.8e9);
//     LargeArray<float> radii(1'000'000'000, LargeAllocator<float>(pages)); // core/base/large_array.h
#pragma once

#include "core/base/error.h"
#include "core/base/large_array.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace ramus {

// The disk has no room, or files cannot be made on it. run_limited() turns it into its error.
struct DiskRefusal : std::runtime_error {
    explicit DiskRefusal(Error why) : std::runtime_error(why.message()), error(std::move(why)) {}
    Error error;
};

class DiskPages final : public ArrayMemory {
public:
    // The files lie in the folder of `target`, the file that will be written. If `target` is empty, or exists and is no
    // regular file, they lie in $TMPDIR, or /var/tmp. `most_bytes`: limit of the resident memory of the whole process.
    // The first allocation creates the first file.
    DiskPages(std::filesystem::path target, double most_bytes);

    // All bytes are 0. Throws DiskRefusal.
    [[nodiscard]] void* allocate(std::size_t bytes) override;
    void deallocate(void* memory) noexcept override;
    // Drops all mapped pages from resident memory, and lets the system read ahead in the present arrays. To be called
    // when these are completely written.
    void release_resident() const;

    // The least memory, in bytes, that must be left for the pages that are mapped between two looks.
    static constexpr double kLeastLeft = 40e6;

private:
    void drop() const; // under the mutex
    void watch(const std::stop_token& stop) const;
    [[noreturn]] void refuse(std::size_t bytes, int code) const;

    std::filesystem::path target_;
    bool elsewhere_; // not in the folder of the target
    std::filesystem::path folder_;
    double most_bytes_;
    mutable std::mutex mutex_;
    std::map<void*, std::size_t> mapped_; // bytes, by address
    std::jthread watcher_;                // ends before the others do
};

} // namespace ramus
