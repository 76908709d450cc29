// Reading whole files, words of their lines, and saying why one cannot be read.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// All bytes of a regular file or a pipe, or an error that says why not. At most `limit` bytes.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uintmax_t limit = std::uintmax_t{4} << 30);

// Whether there is a file to be read at `path`, or an error that says why not. Does not open it.
[[nodiscard]] Result<void> check_input(const std::filesystem::path& path);

// What stands between blanks, in the order of the text.
void split_words(std::string_view text, std::string_view blanks, std::vector<std::string_view>& words);

} // namespace ramus::io
