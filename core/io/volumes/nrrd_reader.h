// Reads NRRD (teem.sourceforge.net/nrrd/format.html): a text header, and values after it (.nrrd) or in other files
// (.nhdr); binary, compressed by gzip, or as text. The fields space, space directions and space origin, or else
// spacings, give the position of the voxels. Declared sizes are checked against the size of the file and the allowed
// memory before anything is allocated.
#pragma once

#include "core/io/volumes/volume_file.h"

#include <string_view>

namespace ramus::io {

[[nodiscard]] inline bool is_nrrd(std::string_view head) { return head.starts_with("NRRD0"); }

// Reads one volume with a single number for each voxel, or the layers of a segmentation (slicer_segments.h). Fails on
// axes of colours, vectors or several volumes, on blocks, on the encodings bzip2 and hex, and on several files of
// values with headers or as text.
[[nodiscard]] Result<volume::Volume> read_nrrd(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
