// Extensions of a NIfTI header: what stands between the header and the voxels. Only names of labels are taken.
#pragma once

#include "core/volume/volume.h"

#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// `bytes`: from the four bytes behind the header, which say whether there are extensions, to the first voxel.
// `swapped`: the file has the other byte order. The names of the first extension that holds a LabelTable, of any code;
// a note says so, and that an extension is damaged, which is no error: it says nothing of the voxels.
[[nodiscard]] std::vector<volume::LabelName> extension_names(std::string_view bytes, bool swapped,
                                                             std::vector<std::string>& notes);

// Most bytes of extensions that are looked at.
inline constexpr std::size_t kMostExtensionBytes = std::size_t{16} << 20;

} // namespace ramus::io
