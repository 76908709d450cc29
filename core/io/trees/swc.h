// Reads and writes SWC: one point a line, `id type x y z radius parent`. The reader accepts any type code, ids in any
// order and of up to 18 digits, several roots (a negative parent), tabs, blanks or commas, CRLF, a byte order mark, and
// comments after `#` anywhere. If the first line names the columns, without `#`, they may be in any order. The format
// states no unit; files written by ramus state unit and axes, or that they are unknown, in a comment.
#pragma once

#include "core/io/buffered_file.h"
#include "core/io/trees/tree_file.h"

namespace ramus::io {

// The comment that ramus writes above the points; the text of claims_text() follows it.
inline constexpr std::string_view kSwcColumns = "# id type x y z radius parent ";

// The tree's claims as text: "(mm, RAS)", or "(unknown, unknown)". For a tree that was made from a mask, the three
// edges of a voxel follow: "(mm, RAS) voxel 0.7 0 0 0 0.7 0 0 0 1.5".
[[nodiscard]] std::string claims_text(const tree::VesselTree& tree);
// Parses a text of claims_text(), and what may follow it, into `imported`. False: it is no such text.
bool take_claims(std::string_view claims, ImportedTree& imported);

// Whether the first line, except comments and a line that names the columns, is a point.
[[nodiscard]] bool is_swc(std::string_view head);

[[nodiscard]] Result<ImportedTree> parse_swc(const TreeInput& input);

// Writes each comment on a line after `#`.
void write_comments(BufferedFile& file, const std::vector<std::string>& comments);

// Writes a tree as SWC. Numbers read back exactly, and the tree keeps its branch ids. Lines keep the order of the
// points if that preserves the ids. Fails on a network with loops, because SWC has one parent for each point.
// `comments` come first, one a line.
[[nodiscard]] Result<void> write_swc(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
