// ByteStage: a stream of bytes for ByteSource: a file, memory, or the decompressed bytes of another stage.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace ramus::io {

class ByteStage {
public:
    ByteStage() = default;
    ByteStage(const ByteStage&) = delete;
    ByteStage& operator=(const ByteStage&) = delete;
    virtual ~ByteStage() = default;
    // Reads up to `bytes` bytes; 0 only at the end. Errors do not name the file.
    [[nodiscard]] virtual Result<std::size_t> read(char* into, std::size_t bytes) = 0;
};

[[nodiscard]] Result<std::unique_ptr<ByteStage>> file_stage(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<ByteStage> memory_stage(std::string_view bytes);

// Decompresses `first` followed by `rest`: gzip (also several concatenated streams) or zlib. read() fails on damaged
// bytes, on a wrong checksum, and on a truncated stream.
[[nodiscard]] std::unique_ptr<ByteStage> inflate_stage(std::string first, std::unique_ptr<ByteStage> rest);

} // namespace ramus::io
