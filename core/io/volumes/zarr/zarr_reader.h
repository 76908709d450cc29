// Reads volumes in Zarr's format, version 2: arrays, and OME-Zarr images (OME-NGFF 0.1 to 0.4). A volume is a folder
// with chunks of numbers, which are not compressed, or by zlib, gzip or blosc. Distances come from the attributes of
// the image. The sides of the patient are always assumed.
#pragma once

#include "core/io/volumes/volume_file.h"

#include <filesystem>

namespace ramus::io {

// Fails on what zarr_image() and zarr_stage() refuse, on several channels or time points of which none is chosen, on
// damaged chunks, and if no chunk is there. Missing chunks have the array's fill value.
[[nodiscard]] Result<volume::Volume> read_zarr_folder(const std::filesystem::path& folder,
                                                      const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
