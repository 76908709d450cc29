// Reading volumes: one function for every format (volumes/volume_format.h).
#pragma once

#include "core/io/volumes/volume_format.h"

namespace ramus::io {

// The volume in `path`, in mm, RAS. The content of the file says which format it has. Fails with the file's name and a
// remedy on whatever is wrong with it, on what would take more memory than allowed, before that is taken, and when
// `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options,
                                                 Job& job);

} // namespace ramus::io
