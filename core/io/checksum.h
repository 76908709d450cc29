// SHA-256 (FIPS 180-4) of what is read, so that a report says of which files it is; and which files those are. The sums
// are those that `sha256sum` prints; libcrypto makes them.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// 64 digits, of the bytes as they lie on the disk. Of a folder: the sum of one line for each file below it, "SUM  NAME"
// as `sha256sum` writes them, by name. Fails when something cannot be read.
[[nodiscard]] Result<std::string> sha256_of(const std::filesystem::path& path);

// The files that are read when `path` is: itself or the files of the folder, the other table of a pair
// (core/io/trees/csv_pair.h), the values that a header of NRRD or MetaImage names. Those that exist.
[[nodiscard]] std::vector<std::filesystem::path> files_read_with(const std::filesystem::path& path);

} // namespace ramus::io
