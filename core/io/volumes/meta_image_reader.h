// MetaImage (itk.org/Wiki/ITK/MetaIO/Documentation): a header of text, and values behind it (.mha) or in a file that it
// names (.mhd), as they are, compressed by zlib, or as text. Coordinates are LPS. Where voxels lie comes from
// TransformMatrix, Offset and ElementSpacing under all their names. Every number in the header is a claim, held against
// the size of the file and the memory allowed before anything is allocated.
#pragma once

#include "core/io/volumes/volume_file.h"

#include <string_view>

namespace ramus::io {

[[nodiscard]] inline bool is_meta_image(std::string_view head) {
    return head.starts_with("ObjectType") || head.starts_with("NDims");
}

// One volume of single numbers. Fails with a word on several numbers for each voxel, on values in more than one file,
// and on objects of other kinds.
[[nodiscard]] Result<volume::Volume> read_meta_image(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
