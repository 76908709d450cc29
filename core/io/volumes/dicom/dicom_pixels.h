// Pixels of DICOM images: uncompressed ones straight from the file, others (JPEG, JPEG-LS, JPEG 2000, RLE) through GDCM
// in a process of its own; as numbers of which only the bits that are stored count.
#pragma once

#include "core/io/volumes/dicom/dicom_image.h"
#include "core/volume/voxel_store.h"

#include <string>

namespace ramus::io {

[[nodiscard]] std::uint64_t frame_bytes(const DicomImage& image); // of whole bytes for each pixel, decoded
[[nodiscard]] const char* number_type_name(const DicomImage& image);

// Whether as many pixels can be there as its header claims, before anything is allocated for them.
[[nodiscard]] Result<void> check_pixels(const DicomImage& image, double memory_bytes);

// Bytes `begin` to `begin + bytes` of uncompressed pixels.
[[nodiscard]] Result<std::string> read_pixel_bytes(const DicomImage& image, std::uint64_t begin, std::uint64_t bytes);
// All frames of compressed pixels, one after the other.
[[nodiscard]] Result<std::string> decode_pixels(const DicomImage& image);
// One frame; `decoded`: all frames, if they are compressed.
[[nodiscard]] Result<std::string> frame_pixels(const DicomImage& image, std::size_t frame, const std::string* decoded);

// Puts a frame's numbers, scaled, behind what `store` holds. Changes the bytes.
[[nodiscard]] Result<void> append_frame(const DicomImage& image, const volume::Scaling& scaling, std::string& pixels,
                                        volume::VoxelStore& store);

} // namespace ramus::io
