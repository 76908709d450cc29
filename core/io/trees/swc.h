// SWC: one point a line, `id type x y z radius parent`. Any type code, ids in any order, several roots (parent -1, or
// any negative number), tabs or blanks, CRLF, a byte order mark, comments after `#` anywhere. Positions and radii are
// taken as mm; the file itself has no unit.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// `name` stands for the file in messages.
[[nodiscard]] Result<tree::VesselTree> parse_swc(std::string_view text, const std::string& name,
                                                 const ReadOptions& options = {});

// Vessel trees as SWC. Numbers are the shortest that read back exactly, so that a tree survives the way through SWC
// with its branch ids; lines keep the order of the points where that does. SWC has one parent a point: a network with
// loops cannot be said in it and is refused.
// `comments` stand at the head of the file, one a line.
[[nodiscard]] Result<void> write_swc(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
