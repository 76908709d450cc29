// BufferedFile: bytes on their way to a file, a megabyte at a time.
// The first failure is kept, so that writers need not ask at every number. One thread at a time per file.
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
    // As it lies in memory.
    template <class T> void write_value(const T& value) { write(&value, sizeof value); }
    // As text, whatever the locale: the shortest that reads back exactly.
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
    void close();                // at the end of all that is written
    void keep_error(int result); // of a system call: errno unless it is 0 or there is an error already

    int file_descriptor_;
    int first_error_ = 0; // errno

private:
    void write_through(const void* bytes, std::size_t count);
    void put(const std::byte* bytes, std::size_t count);

    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
};

// `code`, an errno, told to a person.
[[nodiscard]] tl::unexpected<Error> write_error(const std::filesystem::path& target, int code);

} // namespace ramus::io
