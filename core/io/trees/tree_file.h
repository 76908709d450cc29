// Reading and writing vessel trees: one function for every format (trees/tree_format.h). The content of a file says
// which it is, and where it does not, the extension.
#pragma once

#include "core/base/error.h"
#include "core/io/trees/tree_format.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// The tree in `path`, in mm, RAS. Fails with file, line and remedy on whatever is wrong with the file.
[[nodiscard]] Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

// Asked before long work starts: is there a format for this extension, and can a file be made there?
[[nodiscard]] Result<void> check_tree_output(const std::filesystem::path& file);

// In the format of the extension. `comments` stand at the head of formats that can hold them.
[[nodiscard]] Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                                      const std::vector<std::string>& comments = {});

} // namespace ramus::io
