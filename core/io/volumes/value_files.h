// The files of values that a detached header names: one, a list of them (LIST), or a pattern with numbers.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/byte_source.h"

#include <string>
#include <vector>

namespace ramus::io {

// The names in `field`, what a header says of its files: those on the lines behind it for "LIST", those of the pattern
// for "slice%03d.raw 1 66 1". None: the field is the name of one file. Fails on a pattern that is none of one whole
// number, and on more than 65,536 files.
[[nodiscard]] Result<std::vector<std::string>> listed_files(ByteSource& header, const std::string& field);

// The bytes of all these files, one after the other; each is a regular file in the folder of `header` or below, and
// holds as many bytes as all others: `bytes` in all, undone by gzip or zlib first if `compressed`.
[[nodiscard]] Result<ByteSource> open_listed_values(const ByteSource& header, const std::vector<std::string>& names,
                                                    double bytes, bool compressed);

} // namespace ramus::io
