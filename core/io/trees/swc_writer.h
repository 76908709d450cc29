// Vessel trees as SWC. Numbers are the shortest that read back exactly, so that a tree survives the way through SWC
// with its branch ids; lines keep the order of the points where that does. SWC has one parent a point: a network with
// loops cannot be said in it and is refused.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// `comments` stand at the head of the file, one a line.
[[nodiscard]] Result<void> write_swc(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
