// Decompresses the blocks of VTK's XML files: zlib, LZ4 and LZMA, as VTK and ParaView write them. can_grow_to() checks
// a declared size before memory is allocated for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

enum class VtkCompressor : std::uint8_t { kNone, kZlib, kLz4, kLzma };

// The compressor named by the attribute "compressor"; kNone for an empty name. None: unknown.
[[nodiscard]] std::optional<VtkCompressor> vtk_compressor(std::string_view name);

// Whether a block of `packed` compressed bytes can decompress to `size` bytes.
[[nodiscard]] bool can_grow_to(VtkCompressor compressor, std::uint64_t packed, std::uint64_t size);

// Decompresses a block. None: it is damaged, or does not have exactly `size` bytes. can_grow_to() must accept `size`.
// Takes `size` bytes of memory, and for LZMA up to 100 MB in addition.
[[nodiscard]] std::optional<std::string> unpacked_block(VtkCompressor compressor, std::string_view packed,
                                                        std::uint64_t size);

} // namespace ramus::io
