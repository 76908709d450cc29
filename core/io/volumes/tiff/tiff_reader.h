// Reads TIFF and BigTIFF volumes: pages of one file, or a stack of files with a page each. Numbers of 8 to 64 bits,
// signed, unsigned and floating point, and single bits; strips and tiles; the compressions of libtiff. Distances come
// from the description of ImageJ or OME-XML, else from the resolution tags, else they are assumed with a note. The
// sides of the patient are always assumed.
#pragma once

#include "core/io/volumes/tiff/tiff_layout.h"
#include "core/io/volumes/volume_file.h"

#include <filesystem>

namespace ramus::io {

// Reads the pages of the file, or, if it has one page and a stack of files beside it (tiff_stack.h), the stack; a note
// says so. Fails on colours, palettes, pages of different sizes, missing slices, several channels or time points of
// which none is chosen, and damaged files.
[[nodiscard]] Result<volume::Volume> read_tiff(ByteSource& source, const ReadVolumeOptions& options, Job& job);

// Reads the stack of files in the folder.
[[nodiscard]] Result<volume::Volume> read_tiff_folder(const std::filesystem::path& folder,
                                                      const ReadVolumeOptions& options, Job& job);

// Whether a file called .tif or .tiff is directly in the folder and begins as TIFF.
[[nodiscard]] bool holds_tiff(const std::filesystem::path& folder);

} // namespace ramus::io
