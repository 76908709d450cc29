// NRRD (teem.sourceforge.net/nrrd/format.html): a header of text, and values behind it (.nrrd) or in a file beside it
// (.nhdr), as they are, compressed by gzip, or as text. Where voxels lie comes from space, space directions and space
// origin, or from spacings. Every number in the header is a claim, held against the size of the file and the memory
// allowed before anything is allocated.
#pragma once

#include "core/io/volumes/volume_file.h"

#include <string_view>

namespace ramus::io {

[[nodiscard]] inline bool is_nrrd(std::string_view head) { return head.starts_with("NRRD0"); }

// One volume of single numbers. Fails with a word on axes of colours, vectors or several volumes, on blocks, on
// encodings by bzip2 and as hexadecimal digits, and on values in more than one file.
[[nodiscard]] Result<volume::Volume> read_nrrd(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
