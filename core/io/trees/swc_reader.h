// SWC: one point a line, `id type x y z radius parent`. Any type code, ids in any order, several roots (parent -1, or
// any negative number), tabs or blanks, CRLF, a byte order mark, comments after `#` anywhere. Positions and radii are
// taken as mm; the file itself has no unit.
#pragma once

#include "core/io/trees/tree_format.h"

namespace ramus::io {

// `name` stands for the file in messages.
[[nodiscard]] Result<tree::VesselTree> parse_swc(std::string_view text, const std::string& name,
                                                 const ReadOptions& options = {});

} // namespace ramus::io
