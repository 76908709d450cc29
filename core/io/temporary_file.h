// TemporaryFile: bytes kept on the disk for a while, in a file without a name, so that nothing is left of it however
// the program ends. Written at its end, read anywhere. The first failure is kept and returned by check(); one thread at
// a time.
#pragma once

#include "core/base/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

namespace ramus::io {

class TemporaryFile {
public:
    // On the disk of `target`, the file that the bytes will end in and that messages name.
    [[nodiscard]] static Result<TemporaryFile> create(const std::filesystem::path& target);
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    void write(const void* bytes, std::size_t count) {
        if (count > kBufferSize - used_) return write_through(bytes, count);
        std::memcpy(buffer_.get() + used_, bytes, count);
        used_ += count;
    }
    [[nodiscard]] std::uint64_t size() const { return flushed_ + used_; }
    // `count` bytes from `offset` on, all of which have been written. Unset after a failure.
    void read(std::uint64_t offset, void* bytes, std::size_t count);

    // All of it, in order.
    template <class File> void copy_to(File& file) {
        const auto bytes = std::make_unique_for_overwrite<std::byte[]>(kBufferSize);
        for (std::uint64_t at = 0; at < size() && !failed(); at += kBufferSize) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBufferSize, size() - at));
            read(at, bytes.get(), count);
            file.write(bytes.get(), count);
        }
    }

    [[nodiscard]] bool failed() const { return error_ != 0; }
    [[nodiscard]] Result<void> check() const;

private:
    static constexpr std::size_t kBufferSize = std::size_t{1} << 20;

    TemporaryFile(std::filesystem::path target, int descriptor);
    void write_through(const void* bytes, std::size_t count);
    void flush(const std::byte* bytes, std::size_t count);

    std::filesystem::path target_;
    int descriptor_ = -1;
    int error_ = 0; // the first errno
    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
};

} // namespace ramus::io
