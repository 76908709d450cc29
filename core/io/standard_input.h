// Makes standard input a regular file. Commands read an input several times and need its size, neither of which a pipe
// allows. So a pipe is copied to a file without a name in TMPDIR, which replaces it as standard input of this process.
// Nothing is left of the file however the process ends.
//
// Not possible through a pipe: formats of several files (pairs of CSV files, headers with values in another file,
// series of images), and formats that only their extension identifies.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace ramus::io {

// The path that commands use for the input "-".
inline constexpr const char* kStandardInputPath = "/dev/stdin";

// Whether the path is /dev/stdin, /dev/fd/0 or /proc/self/fd/0.
[[nodiscard]] bool is_standard_input(const std::filesystem::path& path);

// The name of an input in messages: its path, or "standard input".
[[nodiscard]] std::string input_name(const std::filesystem::path& path);

// Longest standard input, in bytes.
inline constexpr std::uint64_t kMostStandardInput = std::uint64_t{4} << 30;

// Call it once, before standard input is opened. Does nothing if it is a regular file at its beginning. Fails if it is
// closed, a folder, empty, longer than kMostStandardInput or the free disk space, or if its first bytes have no known
// format; the rest is then not read. On a terminal, prints on standard error that it is waiting.
[[nodiscard]] Result<void> settle_standard_input();

} // namespace ramus::io
