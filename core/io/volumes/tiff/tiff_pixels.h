// Reads the pixels of TIFF pages, a few strips or rows of tiles at a time, as one stream of numbers in this machine's
// byte order: the form in which read_voxels() (voxel_data.h) takes them. A volume is never in memory a second time.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/byte_stage.h"
#include "core/io/volumes/tiff/tiff_layout.h"
#include "core/io/volumes/voxel_data.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::io {

struct TiffFile {
    StoredBytes bytes;
    TiffLayout layout;
};

// A plane of the volume: a page, or pixels that follow those of a page without a page of their own (ImageJ's files of
// more than 4 GB).
struct TiffPlane {
    std::size_t file = 0, page = 0;
    std::uint64_t skipped_bytes = 0; // from the beginning of the page's pixels; only for uncompressed pages
};

// The type of the numbers; single bits become 0 and 1 of kUint8. Fails on colours, palettes, and numbers of other
// sizes.
[[nodiscard]] Result<VoxelType> tiff_voxel_type(const TiffPage& page, const std::string& name);

// Fails on sizes of 0, on other numbers of strips or tiles than the size of the page needs, on compressions that are
// not read, and on strips or tiles that take more than `memory_bytes`. `name`: of the file, with the page.
[[nodiscard]] Result<void> check_tiff_page(const TiffPage& page, double memory_bytes, const std::string& name);

// The most bytes of numbers that the file can hold, by its size and its compressions.
[[nodiscard]] double most_tiff_bytes(const TiffFile& file);

// The numbers of all planes. All pages must have passed check_tiff_page(), and have equal sizes and types.
[[nodiscard]] std::unique_ptr<ByteStage> tiff_stage(std::vector<TiffFile> files, std::vector<TiffPlane> planes);

} // namespace ramus::io
