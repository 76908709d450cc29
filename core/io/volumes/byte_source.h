// ByteSource: the bytes of a file, compressed by gzip or not, one after the other. Compression is seen by the content,
// not by the name; of files that are compressed behind a header only, the reader says where that begins. Damage shows
// where it is met: a checksum at the end of all bytes.
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

enum class Unpack { kGzip, kNothing }; // gzip is seen and undone, or bytes come as they are

class ByteSource {
public:
    [[nodiscard]] static Result<ByteSource> open(const std::filesystem::path& path, Unpack unpack = Unpack::kGzip);
    // Bytes that outlive the source, as if they were a file of that name; it has no path, and so no files beside it.
    [[nodiscard]] static Result<ByteSource> of_memory(std::string_view bytes, std::string name);
    // What a stage gives, `most_bytes` at the most.
    [[nodiscard]] static Result<ByteSource> of_stage(std::unique_ptr<ByteStage> stage, std::string name,
                                                     double most_bytes);
    ByteSource(ByteSource&&) noexcept;
    ByteSource& operator=(ByteSource&&) noexcept;
    ~ByteSource();

    [[nodiscard]] const std::string& name() const { return name_; }
    // Empty: of memory or standard input, with no files beside it.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Whether all of the file is compressed.
    [[nodiscard]] bool is_gzip() const { return gzip_; }
    // The first bytes of the file, up to kHeadBytes, whatever has been read since.
    [[nodiscard]] std::string_view head() const { return head_; }
    // More than this cannot come any more, so far as the size of the file tells: gzip takes 1032 bytes for one at the
    // most.
    [[nodiscard]] double most_bytes() const { return most_bytes_ - static_cast<double>(used_); }
    // How many come, where that is known: not of what is compressed, nor of pipes.
    [[nodiscard]] std::optional<std::uint64_t> exact_bytes() const;

    // Exactly so many bytes, or an error.
    [[nodiscard]] Result<void> read(void* into, std::size_t bytes);
    // So many, or fewer at the end of the file.
    [[nodiscard]] Result<std::size_t> read_some(void* into, std::size_t bytes);
    // The text up to the next line feed, without it and a carriage return before it; false: there is no more. Fails on
    // lines above `limit` bytes.
    [[nodiscard]] Result<bool> read_line(std::string& line, std::size_t limit);
    [[nodiscard]] Result<void> skip(std::uint64_t bytes);
    // From here on the file is compressed, by gzip or zlib: what is read is what was compressed.
    void inflate_rest();
    // After the last byte that is wanted: whether the file's own checksum agrees, if it ends here.
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
