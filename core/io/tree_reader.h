// Reading vessel trees: one function for every format, chosen by the file's extension.
#pragma once

#include "core/base/error.h"
#include "core/tree/build_tree.h"

#include <filesystem>
#include <string>

namespace ramus::io {

struct ReadOptions {
    tree::Repair repair = tree::Repair::kAll;
};

// The tree in `path`, in mm. Fails with file, line and remedy on whatever is wrong with the file.
[[nodiscard]] Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

// All bytes of a regular file, or an error that says why not. At most `limit` bytes.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::uintmax_t limit = std::uintmax_t{4} << 30);

// Whether there is a file to be read at `path`, or an error that says why not.
[[nodiscard]] Result<void> check_input(const std::filesystem::path& path);

} // namespace ramus::io
