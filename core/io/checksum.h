// SHA-256 (FIPS 180-4, by libcrypto) of input files, so that a report identifies its inputs. Equal to the output of
// `sha256sum`.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// The checksum of the bytes on the disk (not decompressed), as 64 hexadecimal digits. For a folder: of a list with the
// line "SUM  NAME", as `sha256sum` writes it, for each file below it, by name. Fails if a file cannot be read.
[[nodiscard]] Result<std::string> sha256_of(const std::filesystem::path& path);

// Of these bytes: the 32 bytes of the checksum, as base64, as Content-Security-Policy takes them. Empty: libcrypto
// failed.
[[nodiscard]] std::string sha256_base64(std::string_view bytes);

// The existing files that a reader of `path` reads: the file itself or all files of the folder, the other table of a
// pair (core/io/trees/csv_pair.h), and the file of values that a header of NRRD or MetaImage names. Not included: the
// files of a list or pattern in a header (core/io/volumes/value_files.h), and descriptions of labels next to a mask.
[[nodiscard]] std::vector<std::filesystem::path> files_read_with(const std::filesystem::path& path);

} // namespace ramus::io
