// Decompresses gzip and zlib in memory, with a limit on the result. For streams see volumes/byte_source.h.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus::io {

[[nodiscard]] bool is_gzip(std::string_view bytes);

// Decompresses gzip (also several concatenated files) or zlib. `where`: the place in messages. Ignores other bytes
// after the end. Fails on damaged or truncated bytes, and on a result of more than `limit` bytes.
[[nodiscard]] Result<std::string> inflated(std::string_view bytes, std::uint64_t limit, const std::string& where);

inline constexpr std::uint64_t kMostInflation = 1032; // largest possible ratio of zlib

// A sensible limit for text of so many compressed bytes: 200 times as many, at least 16 MiB, at most 2 GiB. A file that
// exceeds it is most likely an attempt to exhaust the memory.
[[nodiscard]] std::uint64_t inflation_limit(std::uint64_t compressed);

} // namespace ramus::io
