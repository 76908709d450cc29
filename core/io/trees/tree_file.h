// Vessel trees from and to files: the formats, one row each, and the functions that read and write them all. A new
// format is a pair of files beside this and a row in tree_file.cpp. The content of a file says which format it has, and
// where it does not, the extension. Files of any format may be compressed by gzip.
#pragma once

#include "core/base/error.h"
#include "core/io/file_format.h"
#include "core/io/trees/imported_tree.h"
#include "core/tree/vessel_tree.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// What a reader is given: all bytes of the file, uncompressed, and how to name it in messages.
struct TreeInput {
    std::string_view text;
    std::string name;
    const ReadOptions& options;
    std::filesystem::path path; // where it lies, for formats of two files; empty: nowhere
};

// Which arrays (core/tree/data_array.h) a file has a place for.
enum class WritesData : std::uint8_t { kNone, kOfPoints, kAll };

struct TreeFormat : FileFormat {
    // What stands in the file; null: it is not read. Fails with place and remedy on whatever is wrong with it.
    Result<ImportedTree> (*parse)(const TreeInput&) = nullptr;
    // `comments` stand at the head of formats that can hold them; null: it is not written.
    Result<void> (*write)(const tree::VesselTree&, const std::filesystem::path&,
                          const std::vector<std::string>& comments) = nullptr;
    WritesData writes_data = WritesData::kNone;
    // The same in these axes, which the file states; null: it has no word for them that programs look for.
    Result<void> (*write_in)(const tree::VesselTree&, const std::filesystem::path&,
                             const std::vector<std::string>& comments, const Orientation& axes) = nullptr;
};

[[nodiscard]] inline bool is_read(const TreeFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const TreeFormat& format) { return format.write != nullptr; }

[[nodiscard]] const std::vector<TreeFormat>& tree_formats();

// ".swc or .json": of the formats that are read, and of those that are written.
[[nodiscard]] std::string readable_tree_extensions();
[[nodiscard]] std::string writable_tree_extensions();

// Whether the name is that of a tree that can be read.
[[nodiscard]] bool names_tree(const std::filesystem::path& path);

// The tree in `path`, in mm, RAS. Fails with file, line and remedy on whatever is wrong with the file.
[[nodiscard]] Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

// The same of the bytes of a file that is called `name`.
[[nodiscard]] Result<tree::VesselTree> parse_tree(std::string_view text, const std::string& name,
                                                  const ReadOptions& options = {});

// Asked before long work starts: is there a format for this extension, which can state `axes`, and
// can a file be made there?
[[nodiscard]] Result<void> check_tree_output(const std::filesystem::path& file,
                                             const std::optional<Orientation>& axes = {});

// What of the tree's data a file of this name has no place for, in a sentence; empty: nothing.
[[nodiscard]] std::string data_left_out(const tree::VesselTree& tree, const std::filesystem::path& file);

// In the format of the extension. `comments` stand at the head of formats that can hold them. `axes` (none: as usual
// for the format, RAS but for 3D Slicer's curves): fails where the format cannot state them, and where nobody has said
// where the tree's axes lead.
[[nodiscard]] Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                                      const std::vector<std::string>& comments = {},
                                      const std::optional<Orientation>& axes = {});

} // namespace ramus::io
