// Where the bytes of a ByteSource come from: a file, memory, or another stage whose bytes are compressed.
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
    // As many bytes as there are, up to `bytes`; 0 at the end alone. Errors come without the name of the file.
    [[nodiscard]] virtual Result<std::size_t> read(char* into, std::size_t bytes) = 0;
};

[[nodiscard]] Result<std::unique_ptr<ByteStage>> file_stage(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<ByteStage> memory_stage(std::string_view bytes);

// What `first` and then `rest` are, undone: gzip (also several one behind the other) or zlib. Fails on bytes that make
// no sense, on a wrong checksum, and where the file ends before the compressed stream does.
[[nodiscard]] std::unique_ptr<ByteStage> inflate_stage(std::string first, std::unique_ptr<ByteStage> rest);

} // namespace ramus::io
