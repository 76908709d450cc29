// Reading whole files, words of their lines, and saying why one cannot be read.
#pragma once

#include "core/base/error.h"
#include "core/io/run_inputs.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// All bytes of a regular file or a pipe, or an error that says why not. At most `limit` bytes; of a pipe, whose length
// nobody knows, no more than kMostPipeBytes. Takes as much memory as the file has bytes, a pipe three times that. Notes
// the file as an input of this run.
inline constexpr std::uintmax_t kMostPipeBytes = std::uintmax_t{256} << 20;
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uintmax_t limit = std::uintmax_t{4} << 30,
                                            InputKind kind = InputKind::kFile);

// Whether there is a file or a pipe to be read at `path`, or an error that says why not. Does not open it.
[[nodiscard]] Result<void> check_input(const std::filesystem::path& path);

// What stands between blanks, in the order of the text.
void split_words(std::string_view text, std::string_view blanks, std::vector<std::string_view>& words);

} // namespace ramus::io
