// The formats of volumes: one row each. A new one is a pair of files beside this and a row in volume_format.cpp.
// Formats without a reader are known, to be refused by name.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/file_format.h"
#include "core/io/volumes/byte_source.h"
#include "core/volume/volume.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

struct ReadVolumeOptions {
    double memory_bytes = 0.0; // most that the process shall take; 0 = half of the machine's
};

struct VolumeFormat : FileFormat {
    // null: not yet read.
    Result<volume::Volume> (*read)(ByteSource& source, const ReadVolumeOptions&, Job&) = nullptr;
};

[[nodiscard]] inline bool is_read(const VolumeFormat& format) { return format.read != nullptr; }

[[nodiscard]] const std::vector<VolumeFormat>& volume_formats();

// ".nii or .nii.gz": of the formats that are read.
[[nodiscard]] std::string readable_volume_extensions();

// Whether the name is that of a volume, read or not.
[[nodiscard]] bool names_volume(const std::filesystem::path& path);

} // namespace ramus::io
