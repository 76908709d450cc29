// Parses the description of an array in Zarr's format, version 2 (Zarr storage specification version 2; .zarray): its
// shape, its chunks, and how numbers are stored in them.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/voxel_data.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

enum class ZarrCompressor { kNone, kDeflate, kBlosc }; // kDeflate: zlib or gzip

struct ZarrArray {
    std::vector<std::uint64_t> shape, chunks; // of equal length, 2 to 5; all at least 1
    VoxelType type = VoxelType::kUint8;
    bool swapped = false;       // numbers are in the other byte order than this machine's
    bool first_fastest = false; // of the axes in a chunk ("F"); false: the last ("C")
    ZarrCompressor compressor = ZarrCompressor::kNone;
    std::string fill;              // the bytes of one number, in this machine's byte order
    char separator = '.';          // between the numbers in the name of a chunk
    bool states_separator = false; // false: chunks may also be in folders ('/')

    // The largest number if it overflows.
    [[nodiscard]] std::uint64_t chunk_bytes() const;
    [[nodiscard]] std::uint64_t chunks_along(std::size_t axis) const;
};

// Parses .zarray. `name`: of the file, for errors. Fails on other versions, on types and compressors that are not read,
// on filters, and on chunks that cannot be.
[[nodiscard]] Result<ZarrArray> zarr_array(std::string_view text, const std::string& name);

// The file of a chunk: "0.1.2" or "0/1/2".
[[nodiscard]] std::filesystem::path zarr_chunk_name(const std::vector<std::uint64_t>& chunk, char separator);

} // namespace ramus::io
