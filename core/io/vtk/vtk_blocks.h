// The compressed blocks of VTK's XML files: zlib, LZ4 and LZMA, as VTK and ParaView write them. What a block claims to
// grow to is believed only as far as its bytes allow.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

enum class VtkCompressor : std::uint8_t { kNone, kZlib, kLz4, kLzma };

// By the attribute "compressor"; empty: kNone. Nothing: it is not known.
[[nodiscard]] std::optional<VtkCompressor> vtk_compressor(std::string_view name);

// Whether a block of so many bytes can have been `size` bytes.
[[nodiscard]] bool can_grow_to(VtkCompressor compressor, std::uint64_t packed, std::uint64_t size);

// The block as it was. Nothing: it is damaged, or has not exactly `size` bytes. Takes memory for these, and up to 100
// MB in addition for LZMA. `size` is one that can_grow_to() accepts.
[[nodiscard]] std::optional<std::string> unpacked_block(VtkCompressor compressor, std::string_view packed,
                                                        std::uint64_t size);

} // namespace ramus::io
