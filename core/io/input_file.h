// Reads whole files with errors for people, and splits text into words.
#pragma once

#include "core/base/error.h"
#include "core/io/run_inputs.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Reads all bytes of a regular file or a pipe, and registers it as an input of this run (run_inputs.h). Fails if it
// cannot be read, or has more than `limit` bytes; a pipe, whose length is unknown, more than kMostPipeBytes at most.
// Takes as much memory as the file has bytes; for a pipe up to three times as much.
inline constexpr std::uintmax_t kMostPipeBytes = std::uintmax_t{256} << 20;
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uintmax_t limit = std::uintmax_t{4} << 30,
                                            InputKind kind = InputKind::kFile);

// Fails if `path` is no readable file or pipe. Does not open it.
[[nodiscard]] Result<void> check_input(const std::filesystem::path& path);

// Splits `text` at any characters of `blanks` into `words`, which refer to `text`.
void split_words(std::string_view text, std::string_view blanks, std::vector<std::string_view>& words);

} // namespace ramus::io
