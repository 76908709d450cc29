// Reads the pixels of DICOM images: uncompressed ones directly, others (JPEG, JPEG-LS, JPEG 2000, RLE) through GDCM in
// a separate process (core/base/own_process.h). Of each number only the stored bits are used.
#pragma once

#include "core/io/volumes/dicom/dicom_image.h"
#include "core/volume/voxel_store.h"

#include <string>

namespace ramus::io {

[[nodiscard]] std::uint64_t frame_bytes(const DicomImage& image); // of a decoded frame, with whole bytes for each pixel
[[nodiscard]] const char* number_type_name(const DicomImage& image);

// Fails if the file cannot hold the declared pixels, or they take more than `memory_bytes`. Allocates nothing.
[[nodiscard]] Result<void> check_pixels(const DicomImage& image, double memory_bytes);

// Reads bytes `begin` to `begin + bytes` of uncompressed pixels.
[[nodiscard]] Result<std::string> read_pixel_bytes(const DicomImage& image, std::uint64_t begin, std::uint64_t bytes);
// Decodes all frames of compressed pixels, in order.
[[nodiscard]] Result<std::string> decode_pixels(const DicomImage& image);
// The bytes of one frame. `decoded`: the result of decode_pixels(), necessary for several compressed frames.
[[nodiscard]] Result<std::string> frame_pixels(const DicomImage& image, std::size_t frame, const std::string* decoded);

// Appends the scaled numbers of a frame to `store`. Changes `pixels`.
[[nodiscard]] Result<void> append_frame(const DicomImage& image, const volume::Scaling& scaling, std::string& pixels,
                                        volume::VoxelStore& store);

} // namespace ramus::io
