// Decodes chunks of Zarr.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/zarr/zarr_array.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ramus::io {

// A chunk as it is in its file.
struct EncodedChunk {
    std::string name;  // of the file, for errors
    std::string bytes; // empty: the chunk is missing
};

// The most bytes that the file of a chunk can have.
[[nodiscard]] std::uint64_t most_chunk_file_bytes(const ZarrArray& array);

// The numbers of each chunk, in the order of the chunk and the byte order of the array; empty for a missing chunk.
// Fails on chunks that are damaged, or hold more or fewer numbers than the array says.
[[nodiscard]] Result<std::vector<std::string>> decode_chunks(const ZarrArray& array, std::vector<EncodedChunk> chunks);

} // namespace ramus::io
