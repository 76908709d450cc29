// Reads volumes in all formats. The table of formats is in volume_file.cpp; a new format is a row there and a reader in
// this folder. A row without a reader is for a format that is refused with its name.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/file_format.h"
#include "core/io/trees/imported_tree.h"
#include "core/io/volumes/byte_source.h"
#include "core/io/volumes/volume_part.h"
#include "core/volume/volume.h"
#include "core/volume/voxel_store.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct ReadVolumeOptions {
    double memory_bytes = 0.0;           // memory limit of the process; 0: half of the machine's memory
    std::optional<LengthUnit> unit = {}; // overrides the file's unit
    VolumePart part = {};                // of files that hold several volumes
    // Keeps only which values are at least this one (Volume::threshold), which takes the memory of a mask. None: keeps
    // values.
    std::optional<double> threshold = {};
    // What the reader may take of memory now, and what it keeps.
    [[nodiscard]] volume::Keeping keeping() const;
};

struct VolumeFormat : FileFormat {
    // Null: no file of this format can be read.
    Result<volume::Volume> (*read)(ByteSource& source, const ReadVolumeOptions&, Job&) = nullptr;
    // For formats whose volumes are folders: whether a folder holds such a volume, and its reader. Else null.
    bool (*is_folder)(const std::filesystem::path& folder) = nullptr;
    Result<volume::Volume> (*read_folder)(const std::filesystem::path& folder, const ReadVolumeOptions&,
                                          Job&) = nullptr;
};

[[nodiscard]] inline bool is_read(const VolumeFormat& format) {
    return format.read != nullptr || format.read_folder != nullptr;
}

[[nodiscard]] const std::vector<VolumeFormat>& volume_formats();

// The extensions of the formats that are read: ".nii or .nii.gz".
[[nodiscard]] std::string readable_volume_extensions();

// Whether the extension is that of a volume format, also of one that cannot be read.
[[nodiscard]] bool names_volume(const std::filesystem::path& path);

// Whether `path` is a volume: a file, or a folder of DICOM or TIFF files or of Zarr (core/io/recognise.h).
[[nodiscard]] bool is_volume(const std::filesystem::path& path);

// Reads a volume in mm, RAS. recognise.h decides the format. If neither the file nor `options` state a unit, mm is
// assumed, and a suspicion is added if the size suggests another unit. Fails with the file's name and a remedy, before
// it takes more memory than allowed, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options,
                                                 Job& job);

} // namespace ramus::io
