// Reads MetaImage (itk.org/Wiki/ITK/MetaIO/Documentation): a text header, and values after it (.mha) or in other files
// that it names (.mhd); binary, compressed by zlib, or as text. Coordinates are LPS. TransformMatrix, Offset and
// ElementSpacing, or their synonyms, give the position of the voxels. Declared sizes are checked against the size of
// the file and the allowed memory before anything is allocated.
#pragma once

#include "core/io/volumes/volume_file.h"

#include <string_view>

namespace ramus::io {

[[nodiscard]] inline bool is_meta_image(std::string_view head) {
    return head.starts_with("ObjectType") || head.starts_with("NDims");
}

// Reads one volume with a single number for each voxel. Fails on several numbers for each voxel, on several files of
// values with headers or as text, and on objects of other kinds.
[[nodiscard]] Result<volume::Volume> read_meta_image(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
