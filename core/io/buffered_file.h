// BufferedFile: writes bytes and numbers to a file through a buffer of 1 MiB. Keeps the first error, so callers check
// failed() once and not after each write. Not thread-safe. Base class of OutputFile (output_file.h).
#pragma once

#include "core/base/error.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

namespace ramus::io {

class BufferedFile {
public:
    void write(const void* bytes, std::size_t count) {
        if (count > kBufferSize - used_) return write_through(bytes, count);
        std::memcpy(buffer_.get() + used_, bytes, count);
        used_ += count;
    }
    void write(std::string_view text) { write(text.data(), text.size()); }
    // Binary, in this machine's byte order.
    template <class T> void write_value(const T& value) { write(&value, sizeof value); }
    // As text, independent of the locale: the shortest digits that read back exactly.
    template <class T> void write_number(T value) {
        char digits[32];
        write({digits, std::to_chars(digits, digits + sizeof digits, value).ptr});
    }
    [[nodiscard]] std::uint64_t size() const { return flushed_ + used_; } // written so far
    [[nodiscard]] bool failed() const { return first_error_ != 0; }

protected:
    static constexpr std::size_t kBufferSize = std::size_t{1} << 20;

    explicit BufferedFile(int descriptor);
    BufferedFile(BufferedFile&& other) noexcept;
    ~BufferedFile(); // closes

    void flush();
    void close();                // flushes first
    void keep_error(int result); // `result` of a system call; if not 0, keeps errno unless an error is kept already

    int file_descriptor_;
    int first_error_ = 0; // errno

private:
    void write_through(const void* bytes, std::size_t count);
    void put(const std::byte* bytes, std::size_t count);

    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
};

// An error for people that says why `target` cannot be written. `code`: an errno.
[[nodiscard]] tl::unexpected<Error> write_error(const std::filesystem::path& target, int code);

} // namespace ramus::io
