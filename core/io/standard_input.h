// Standard input as a file. Commands read their inputs more than once (first what they are, then what is in them) and
// want to know how many bytes there are, which a pipe does not tell. So what comes through a pipe is first copied to a
// file without a name in TMPDIR, which takes the place of the pipe as this process's standard input: from then on
// /dev/stdin is a regular file, whoever opens it, and however the process ends nothing is left of it.
//
// Only bytes can come through a pipe: not the other file of a pair of CSV files, values of a header in another file,
// nor the other images of a series, and no name tells what they are.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace ramus::io {

// What a path to standard input is as the input of a command, which people write as "-".
inline constexpr const char* kStandardInputPath = "/dev/stdin";

// Whether the path is that of standard input, in any of its spellings (/dev/stdin, /dev/fd/0, /proc/self/fd/0).
[[nodiscard]] bool is_standard_input(const std::filesystem::path& path);

// What people call an input: its path, or "standard input".
[[nodiscard]] std::string input_name(const std::filesystem::path& path);

// More than this is refused.
inline constexpr std::uint64_t kMostStandardInput = std::uint64_t{4} << 30;

// Once, before standard input is opened for the first time. Does nothing where it is a regular file already. Fails
// where it is closed, empty, longer than kMostStandardInput or the disk, or where its first bytes are those of no
// format that is recognised: then no more is read. Says on standard error that it waits, where it is a terminal.
[[nodiscard]] Result<void> settle_standard_input();

} // namespace ramus::io
