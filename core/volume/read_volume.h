// Reading volumes: one function for every format, chosen by the file's content. NIfTI-1 and NIfTI-2 are read, .nii and
// .nii.gz; NRRD and MetaImage are known and refused with a word.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/volume.h"

#include <filesystem>

namespace ramus::volume {

struct ReadVolumeOptions {
    double memory_bytes = 0.0; // most that the process shall take; 0 = half of the machine's
};

// The volume in `path`, in mm, RAS. Fails with the file's name and a remedy on whatever is wrong with it, on what would
// take more memory than allowed, before that is taken, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job);

// Whether the name is that of a volume, read or not: .nii, .nii.gz, .hdr, .img, .nrrd, .nhdr, .mha, .mhd.
[[nodiscard]] bool names_volume(const std::filesystem::path& path);

} // namespace ramus::volume
