// Writing vessel trees: one function for every format, chosen by the file's extension (.swc, .json).
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// Asked before long work starts: is there a format for this extension, and can a file be made there?
[[nodiscard]] Result<void> check_tree_output(const std::filesystem::path& file);

// `comments` stand at the head of formats that can hold them.
[[nodiscard]] Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                                      const std::vector<std::string>& comments = {});

} // namespace ramus::io
