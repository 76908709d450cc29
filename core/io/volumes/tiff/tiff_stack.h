// Finds the files of a stack: one file for each slice, with names that differ by one number (brain_0001.tif,
// brain_0002.tif, ...). Numbers are compared as numbers, so slice 10 follows slice 9.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <vector>

namespace ramus::io {

// Whether the name is that of a TIFF file: .tif or .tiff.
[[nodiscard]] bool names_tiff(const std::filesystem::path& path);

// The files of the stack in a folder, in order. A folder with one TIFF file gives that file. Fails if there is none, if
// the names differ by more than one number or by other text, if a number is missing or repeated, and on more than
// 65,536 files.
[[nodiscard]] Result<std::vector<std::filesystem::path>> tiff_stack_in(const std::filesystem::path& folder);

// The files of the stack that a file belongs to. If its name has several numbers, the one that gives the most files
// counts the slices. A file without others gives that file. Fails like tiff_stack_in().
[[nodiscard]] Result<std::vector<std::filesystem::path>> tiff_stack_of(const std::filesystem::path& file);

} // namespace ramus::io
