// ByteSource: the bytes of a file, compressed by gzip or not, one after the other. Compression is seen by the content,
// not by the name. Damage shows where it is met: a checksum at the end of all bytes.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace ramus::io {

class ByteSource {
public:
    [[nodiscard]] static Result<ByteSource> open(const std::filesystem::path& path);
    ByteSource(ByteSource&&) noexcept;
    ByteSource& operator=(ByteSource&&) noexcept;
    ~ByteSource();

    [[nodiscard]] const std::string& name() const { return name_; }
    // The first bytes of the file, up to 1024, whatever has been read since.
    [[nodiscard]] std::string_view head() const { return head_; }
    // More than this cannot come, so far as the size of the file tells: gzip takes 1032 bytes for one at the most.
    [[nodiscard]] double most_bytes() const { return most_bytes_; }

    // Exactly so many bytes, or an error.
    [[nodiscard]] Result<void> read(void* into, std::size_t bytes);
    [[nodiscard]] Result<void> skip(std::uint64_t bytes);
    // After the last byte that is wanted: whether the file's own checksum agrees, if it ends here.
    [[nodiscard]] Result<void> check_end();

private:
    struct State;
    ByteSource(std::unique_ptr<State> state, std::string name);
    [[nodiscard]] Result<std::size_t> read_some(void* into, std::size_t bytes);

    std::unique_ptr<State> state_;
    std::string name_, head_;
    std::size_t head_used_ = 0;
    double most_bytes_ = 0.0;
};

} // namespace ramus::io
