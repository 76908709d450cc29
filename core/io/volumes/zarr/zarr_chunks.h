// Reads the chunks of a Zarr array as one stream of numbers, x first, then y, then z: the form in which read_voxels()
// (voxel_data.h) takes them. Memory holds one layer of chunks along z at a time, without its zeros, and the chunks that
// are being decoded. Blosc decodes in a separate process (core/base/own_process.h).
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/volumes/byte_stage.h"
#include "core/io/volumes/zarr/zarr_image.h"

#include <array>
#include <cstdint>
#include <memory>

namespace ramus::io {

// Fails, before memory is allocated, on chunks that take more memory than is left, and on more than 16 million chunks.
// The stage fails on damaged chunks, and if none of the chunks is there. `memory_bytes`: limit for the process; 0: half
// of the machine's memory. The stage's numbers are in the byte order of the array.
[[nodiscard]] Result<std::unique_ptr<ByteStage>> zarr_stage(const ZarrImage& image, const ChosenPart& part,
                                                            double memory_bytes, const Job& job);

// The extents of the volume along x, y and z.
[[nodiscard]] std::array<std::uint64_t, 3> zarr_extents(const ZarrImage& image);

} // namespace ramus::io
