// Reads and writes vessel trees in all formats. The table of formats is in tree_file.cpp; a new format is a row there
// and a reader or writer in this folder. recognise.h decides the format of a file. Files of any format may be
// compressed by gzip.
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

// The input of a reader: all bytes of the file, uncompressed, and its name in messages.
struct TreeInput {
    std::string_view text;
    std::string name;
    const ReadOptions& options;
    std::filesystem::path path; // for formats of two files; empty: none
};

// Which data arrays (core/tree/data_array.h) a format can hold.
enum class WritesData : std::uint8_t { kNone, kOfPoints, kAll };

struct TreeFormat : FileFormat {
    // Reads the file. Fails with place and remedy. Null: the format is not read.
    Result<ImportedTree> (*parse)(const TreeInput&) = nullptr;
    // Writes the tree, with `comments` at the head if the format can hold them. Null: the format is not written.
    Result<void> (*write)(const tree::VesselTree&, const std::filesystem::path&,
                          const std::vector<std::string>& comments) = nullptr;
    WritesData writes_data = WritesData::kNone;
    // The same in `axes`, which the file states. Null: the format has no common way to state them.
    Result<void> (*write_in)(const tree::VesselTree&, const std::filesystem::path&,
                             const std::vector<std::string>& comments, const Orientation& axes) = nullptr;
};

[[nodiscard]] inline bool is_read(const TreeFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const TreeFormat& format) { return format.write != nullptr; }

[[nodiscard]] const std::vector<TreeFormat>& tree_formats();

// The extensions of the formats that are read, and of those that are written: ".swc or .json".
[[nodiscard]] std::string readable_tree_extensions();
[[nodiscard]] std::string writable_tree_extensions();

// Whether the extension is that of a tree format that can be read.
[[nodiscard]] bool names_tree(const std::filesystem::path& path);

// Reads a tree in mm, RAS (as far as known: tree::Claims). Fails with file, line and remedy.
[[nodiscard]] Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

// The same for the bytes of a file called `name`.
[[nodiscard]] Result<tree::VesselTree> parse_tree(std::string_view text, const std::string& name,
                                                  const ReadOptions& options = {});

// Checks before long work whether the format of the extension can state `axes`, and the file can be created.
[[nodiscard]] Result<void> check_tree_output(const std::filesystem::path& file,
                                             const std::optional<Orientation>& axes = {});

// A sentence about the data of the tree that the format of `file` cannot hold. Empty: it can hold all.
[[nodiscard]] std::string data_left_out(const tree::VesselTree& tree, const std::filesystem::path& file);

// Writes in the format of the extension, with `comments` at the head if the format can hold them. `axes`: none for the
// default of the format, RAS except for 3D Slicer's curves. Fails if the format cannot state `axes`, and if they are
// not RAS and the tree's own axes are unknown.
[[nodiscard]] Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                                      const std::vector<std::string>& comments = {},
                                      const std::optional<Orientation>& axes = {});

} // namespace ramus::io
