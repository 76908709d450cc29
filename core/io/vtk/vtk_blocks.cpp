#include "core/io/vtk/vtk_blocks.h"

#include "core/base/words.h"
#include "core/io/inflate.h"

#include <limits>
#include <lz4.h>
#include <lzma.h>

namespace ramus::io {

namespace {

constexpr std::pair<std::string_view, VtkCompressor> kVtkCompressors[] = {
    {"", VtkCompressor::kNone},
    {"vtkZLibDataCompressor", VtkCompressor::kZlib},
    {"vtkLZ4DataCompressor", VtkCompressor::kLz4},
    {"vtkLZMADataCompressor", VtkCompressor::kLzma}};

constexpr std::uint64_t kMostLz4 = 255;            // largest ratio: each byte of a length adds at most 255
constexpr std::uint64_t kLzmaMemory = 100'000'000; // the strongest preset needs 65 MiB

bool unpack_lz4(std::string_view packed, std::string& plain) {
    constexpr std::size_t kMost = std::numeric_limits<int>::max();
    if (packed.size() > kMost || plain.size() > kMost) return false;
    const int size = LZ4_decompress_safe(packed.data(), plain.data(), static_cast<int>(packed.size()),
                                         static_cast<int>(plain.size()));
    return size >= 0 && static_cast<std::size_t>(size) == plain.size();
}

bool unpack_lzma(std::string_view packed, std::string& plain) {
    std::uint64_t memory = kLzmaMemory;
    std::size_t in = 0, out = 0;
    const lzma_ret result =
        lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &in,
                                  packed.size(), reinterpret_cast<std::uint8_t*>(plain.data()), &out, plain.size());
    return result == LZMA_OK && out == plain.size();
}

} // namespace

std::optional<VtkCompressor> vtk_compressor(std::string_view name) { return paired(kVtkCompressors, name); }

// No limit for LZMA: a few bytes may decompress to megabytes. VtkXmlData limits the sum of all arrays.
bool can_grow_to(VtkCompressor compressor, std::uint64_t packed, std::uint64_t size) {
    switch (compressor) {
    case VtkCompressor::kNone:
        return size == packed;
    case VtkCompressor::kZlib:
        return size / kMostInflation <= packed;
    case VtkCompressor::kLz4:
        return size / kMostLz4 <= packed;
    case VtkCompressor::kLzma:
        return packed > 0;
    }
    return false;
}

std::optional<std::string> unpacked_block(VtkCompressor compressor, std::string_view packed, std::uint64_t size) {
    if (compressor == VtkCompressor::kZlib) {
        auto plain = inflated(packed, size, {});
        return plain && plain->size() == size ? std::optional(std::move(*plain)) : std::nullopt;
    }
    std::string plain(size, '\0');
    const bool good = compressor == VtkCompressor::kLz4    ? unpack_lz4(packed, plain)
                      : compressor == VtkCompressor::kLzma ? unpack_lzma(packed, plain)
                                                           : false;
    return good ? std::optional(std::move(plain)) : std::nullopt;
}

} // namespace ramus::io
