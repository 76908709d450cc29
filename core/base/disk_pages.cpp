#include "core/base/disk_pages.h"

#include "core/base/descriptor.h"
#include "core/base/memory.h"
#include "core/base/words.h"

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <utility>

namespace ramus {

namespace fs = std::filesystem;

namespace {

// The watching thread can run late while other threads use all cores (measured: by up to 50 ms, on two cores). Most of
// the room is for the pages that they map meanwhile.
constexpr std::chrono::milliseconds kBetweenLooks(5);
constexpr double kShare = 0.25; // of the room that other memory leaves
// Allocators keep what is freed, which counts as resident. From so much other memory on, as a share of the limit, it is
// given back; not more often, since that takes up to a tenth of a second.
constexpr double kMuch = 0.7;
constexpr std::chrono::seconds kBetweenReturns(2);

// Whether files cannot lie beside this one.
bool is_no_file_on_disk(const fs::path& target) {
    std::error_code code;
    const fs::file_status status = fs::status(target, code);
    return target.empty() || (!code && fs::exists(status) && !fs::is_regular_file(status));
}

fs::path temporary_folder() {
    const char* folder = std::getenv("TMPDIR");
    return folder != nullptr && *folder != 0 ? folder : "/var/tmp";
}

std::string gigabytes(double bytes) { return in_digits(bytes / 1e9, 3) + " GB"; }

} // namespace

DiskPages::DiskPages(fs::path target, double most_bytes)
    : target_(std::move(target)), elsewhere_(is_no_file_on_disk(target_)),
      folder_(elsewhere_ ? temporary_folder() : fs::absolute(target_).lexically_normal().parent_path()),
      most_bytes_(most_bytes) {}

void* DiskPages::allocate(std::size_t bytes) {
    Descriptor file(open_without_name(folder_));
    if (file.number() < 0) refuse(bytes, errno);
    int code = EINTR;
    while (code == EINTR) code = ::posix_fallocate(file.number(), 0, static_cast<off_t>(bytes));
    if (code != 0) {
        file.close(); // frees the part that was reserved, before refuse() looks at the free space
        refuse(bytes, code);
    }
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
    if (memory == MAP_FAILED) refuse(bytes, errno);
    // With read-ahead a new file gets large pages in the system's cache, and one byte then maps megabytes (Linux 6.18).
    madvise(memory, bytes, MADV_RANDOM);
    const std::lock_guard lock(mutex_);
    mapped_.emplace(memory, bytes);
    if (!watcher_.joinable()) watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
    return memory;
}

void DiskPages::deallocate(void* memory) noexcept {
    const std::lock_guard lock(mutex_);
    const auto at = mapped_.find(memory);
    munmap(memory, at->second);
    mapped_.erase(at);
}

void DiskPages::release_resident() const {
    const std::lock_guard lock(mutex_);
    for (const auto& [memory, bytes] : mapped_) madvise(memory, bytes, MADV_NORMAL);
    drop();
}

// The files keep the content.
void DiskPages::drop() const {
    for (const auto& [memory, bytes] : mapped_) madvise(memory, bytes, MADV_DONTNEED);
}

void DiskPages::watch(const std::stop_token& stop) const {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    auto returned = std::chrono::steady_clock::now();
    while (!stop.stop_requested()) {
        never.wait_for(lock, stop, kBetweenLooks, [] { return false; });
        const double of_files = process_file_memory(), other = process_memory() - of_files;
        if (const auto now = std::chrono::steady_clock::now();
            other > kMuch * most_bytes_ && now - returned > kBetweenReturns) {
            release_unused_memory();
            returned = now;
        }
        if (of_files <= kShare * (most_bytes_ - other)) continue;
        const std::lock_guard mapped(mutex_);
        drop();
    }
}

void DiskPages::refuse(std::size_t bytes, int code) const {
    const std::lock_guard lock(mutex_);
    double there = 0.0;
    for (const auto& [memory, size] : mapped_) there += static_cast<double>(size);
    Error error{"this needs " + gigabytes(there + static_cast<double>(bytes)) + " or more on the disk of " +
                    folder_.string(),
                target_.string(), ""};
    const std::string another_disk = elsewhere_ ? "set TMPDIR to a folder on another disk" : "write to another disk";
    if (code == ENOSPC || code == EDQUOT) {
        std::error_code unknown;
        const fs::space_info space = fs::space(folder_, unknown);
        if (!unknown)
            error.what += ", which has " + gigabytes(there + static_cast<double>(space.available)) + " for it";
        error.hint = "nothing was written; free some space, " + another_disk + ", or raise --memory";
    } else if (code == EFBIG) {
        error.what += ", in files larger than this system allows";
        error.hint = "nothing was written; raise the limit (ulimit -f) or --memory";
    } else {
        error.what += std::string(": ") + std::strerror(code);
        error.hint = "nothing was written; " + another_disk + ", or raise --memory";
    }
    throw DiskRefusal(std::move(error));
}

} // namespace ramus
