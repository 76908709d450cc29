// Reads values from several files that a detached header names, as a list (LIST) or as a pattern with numbers.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/byte_source.h"

#include <string>
#include <vector>

namespace ramus::io {

// The names of files that the header's `field` means: for "LIST" the lines that follow in `header`, for
// "slice%03d.raw 1 66 1" the names of the pattern (first, last, step). Empty: the field is the name of one file. Fails
// on an invalid pattern, and on more than 65,536 files.
[[nodiscard]] Result<std::vector<std::string>> listed_files(ByteSource& header, const std::string& field);

// The concatenated bytes of these files. Each must be a regular file in the folder of `header` or below, and all must
// hold equally many bytes, `bytes` in total. `compressed`: each is compressed by gzip or zlib.
[[nodiscard]] Result<ByteSource> open_listed_values(const ByteSource& header, const std::vector<std::string>& names,
                                                    double bytes, bool compressed);

} // namespace ramus::io
