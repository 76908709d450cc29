// ByteSource: reads the bytes of a file in order, and decompresses gzip. Compression is recognised by the content, not
// by the name. For files with compressed data after a plain header, the reader calls inflate_rest(). Damage is reported
// when the damaged bytes are read; a wrong checksum only at the end (check_end()).
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

class ByteStage;

enum class Unpack { kGzip, kNothing }; // decompress gzip if recognised, or return the bytes as they are

class ByteSource {
public:
    [[nodiscard]] static Result<ByteSource> open(const std::filesystem::path& path, Unpack unpack = Unpack::kGzip);
    // Reads `bytes`, which must outlive the source, as if they were a file of that name. The source has no path, so a
    // header in it cannot name other files.
    [[nodiscard]] static Result<ByteSource> of_memory(std::string_view bytes, std::string name);
    // Reads from a stage that gives at most `most_bytes` bytes.
    [[nodiscard]] static Result<ByteSource> of_stage(std::unique_ptr<ByteStage> stage, std::string name,
                                                     double most_bytes);
    ByteSource(ByteSource&&) noexcept;
    ByteSource& operator=(ByteSource&&) noexcept;
    ~ByteSource();

    [[nodiscard]] const std::string& name() const { return name_; }
    // Empty: memory or standard input.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Whether the whole file is compressed.
    [[nodiscard]] bool is_gzip() const { return gzip_; }
    // The first bytes of the file, up to kHeadBytes, independent of the current position.
    [[nodiscard]] std::string_view head() const { return head_; }
    // An upper bound of the bytes that are left, from the size of the file. For gzip, 1032 times the compressed bytes.
    [[nodiscard]] double most_bytes() const { return most_bytes_ - static_cast<double>(used_); }
    // The number of bytes that are left. None: unknown, for compressed data and pipes.
    [[nodiscard]] std::optional<std::uint64_t> exact_bytes() const;

    // Reads exactly `bytes` bytes. Fails if there are fewer.
    [[nodiscard]] Result<void> read(void* into, std::size_t bytes);
    // Reads up to `bytes` bytes; fewer only at the end of the file.
    [[nodiscard]] Result<std::size_t> read_some(void* into, std::size_t bytes);
    // Reads up to the next line feed, and removes it and a carriage return before it. False: end of the file. Fails on
    // lines of more than `limit` bytes.
    [[nodiscard]] Result<bool> read_line(std::string& line, std::size_t limit);
    [[nodiscard]] Result<void> skip(std::uint64_t bytes);
    // The rest of the file is compressed by gzip or zlib: decompresses it from here on.
    void inflate_rest();
    // To be called after the last needed byte. If the file ends there, checks its own checksum.
    [[nodiscard]] Result<void> check_end();

private:
    struct State;
    ByteSource(std::unique_ptr<State> state, std::string name);
    [[nodiscard]] Result<void> begin(double file_bytes, Unpack unpack);
    [[nodiscard]] Result<void> fill();

    std::unique_ptr<State> state_;
    std::string name_, head_;
    std::filesystem::path path_;
    bool gzip_ = false, exact_ = true;
    double most_bytes_ = 0.0; // of all
    std::uint64_t used_ = 0;
};

} // namespace ramus::io
