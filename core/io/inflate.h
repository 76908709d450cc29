// Bytes that gzip or zlib compressed, as they were before, in memory.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus::io {

[[nodiscard]] bool is_gzip(std::string_view bytes);

// gzip (also several files one behind the other) or zlib. `where` names the place in messages. Fails on damaged or
// truncated bytes, and on more than `limit` bytes of result.
[[nodiscard]] Result<std::string> inflated(std::string_view bytes, std::uint64_t limit, const std::string& where);

inline constexpr std::uint64_t kMostInflation = 1032; // no byte that zlib compressed stands for more

// What text of so many compressed bytes may grow to: more is not a tree, but an attempt to fill the memory.
[[nodiscard]] std::uint64_t inflation_limit(std::uint64_t compressed);

} // namespace ramus::io
