// Reads names of labels from the extensions of a NIfTI file, which are between its header and the voxels.
#pragma once

#include "core/volume/volume.h"

#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// The names in the first extension, of any code, that holds a LabelTable (label_names.h). `bytes`: from the four bytes
// after the header, which say whether there are extensions, to the first voxel. `swapped`: the file has the other byte
// order. Adds a note about the names, or about a damaged extension; that is no error, because the voxels are intact.
[[nodiscard]] std::vector<volume::LabelName> extension_names(std::string_view bytes, bool swapped,
                                                             std::vector<std::string>& notes);

// Extensions are read up to this number of bytes.
inline constexpr std::size_t kMostExtensionBytes = std::size_t{16} << 20;

} // namespace ramus::io
