// Volumes from files: the formats, one row each, and one function that reads them all. A new format is a pair of files
// beside this and a row in volume_file.cpp. Formats without a reader are known, to be refused by name.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/file_format.h"
#include "core/io/trees/imported_tree.h"
#include "core/io/volumes/byte_source.h"
#include "core/volume/volume.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct ReadVolumeOptions {
    double memory_bytes = 0.0;           // most that the process shall take; 0 = half of the machine's
    std::optional<LengthUnit> unit = {}; // against what the file says
};

struct VolumeFormat : FileFormat {
    // null: not yet read.
    Result<volume::Volume> (*read)(ByteSource& source, const ReadVolumeOptions&, Job&) = nullptr;
    // Of formats whose volumes are folders: whether this one holds such a volume, and the reader; null: of others.
    bool (*is_folder)(const std::filesystem::path& folder) = nullptr;
    Result<volume::Volume> (*read_folder)(const std::filesystem::path& folder, const ReadVolumeOptions&,
                                          Job&) = nullptr;
};

[[nodiscard]] inline bool is_read(const VolumeFormat& format) { return format.read != nullptr; }

[[nodiscard]] const std::vector<VolumeFormat>& volume_formats();

// ".nii or .nii.gz": of the formats that are read.
[[nodiscard]] std::string readable_volume_extensions();

// Whether the name is that of a volume, read or not.
[[nodiscard]] bool names_volume(const std::filesystem::path& path);

// Whether there is a volume at `path`: a file, or a folder of DICOM files (core/io/recognise.h).
[[nodiscard]] bool is_volume(const std::filesystem::path& path);

// The volume in `path`, in mm, RAS. The content of the file says which format it has. Where it states no unit of
// length, and none is asked for, a volume whose size looks like another than mm gets a suspicion. Fails with the file's
// name and a remedy on whatever is wrong with it, on what would take more memory than allowed, before that is taken,
// and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options,
                                                 Job& job);

} // namespace ramus::io
