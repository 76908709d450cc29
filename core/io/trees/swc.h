// SWC: one point a line, `id type x y z radius parent`. Any type code, ids in any order and of up to 18 digits, several
// roots (parent -1, or any negative number), tabs, blanks or commas, CRLF, a byte order mark, comments after `#`
// anywhere. The first line may name the columns, without `#`; they may then stand in any order. The format has no unit;
// what this program writes says in a comment that it is in mm and RAS, or that this is not known.
#pragma once

#include "core/io/buffered_file.h"
#include "core/io/trees/tree_file.h"

namespace ramus::io {

// The line that this program writes above the points, with its claims behind.
inline constexpr std::string_view kSwcColumns = "# id type x y z radius parent ";

// "(mm, RAS)"; "(unknown, unknown)" of what nobody has said. Of a tree that was made of a mask, the three edges of a
// voxel follow: "(mm, RAS) voxel 0.7 0 0 0 0.7 0 0 0 1.5".
[[nodiscard]] std::string claims_text(const tree::VesselTree& tree);
// Takes as written what `claims` says, a text as claims_text() makes it and what may follow it; false: it is no such
// text.
bool take_claims(std::string_view claims, ImportedTree& imported);

// Whether the first line that is no comment is one of a point.
[[nodiscard]] bool is_swc(std::string_view head);

[[nodiscard]] Result<ImportedTree> parse_swc(const TreeInput& input);

// A line each after `#`, in SWC and in whatever has such comments.
void write_comments(BufferedFile& file, const std::vector<std::string>& comments);

// Vessel trees as SWC. Numbers are the shortest that read back exactly, so that a tree survives the way through SWC
// with its branch ids; lines keep the order of the points where that does. SWC has one parent a point: a network with
// loops cannot be said in it and is refused.
// `comments` stand at the head of the file, one a line.
[[nodiscard]] Result<void> write_swc(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
