// The table of blend modes (which vessels blend into each other, and the field that does it), for the command line,
// sessions and commands.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::field {
class Field;
} // namespace ramus::field

namespace ramus::mesh {

struct FieldParts; // core/mesh/tree_field.h

// kTree: vessels blend along the tree and not across contacts (core/tree/contacts/contacts.h). kPaper: vessels blend
// wherever they come close, as in the paper.
enum class Blend : std::uint8_t { kTree, kPaper };

field::Field separated_field(const FieldParts& parts);
field::Field plain_field(const FieldParts& parts);

struct BlendRow {
    Blend blend;
    std::string_view key;   // in files, commands and on the command line
    std::string_view label; // where it stands alone
    std::string_view help;
    // Whether vessels that are not connected stay apart: then the surface gets the pieces and loops of its tree.
    bool separates;
    // Whether the surface runs along the centerlines, so that pictures may draw cones in its place while the view
    // moves.
    bool along_centerlines;
    field::Field (*make)(const FieldParts& parts);
};

// In the order of `Blend`.
inline constexpr std::array<BlendRow, 2> kBlends = {{
    {Blend::kTree, "tree", "Along the tree", "vessels that only press on each other stay apart (default)", true, true,
     separated_field},
    {Blend::kPaper, "paper", "Wherever close", "vessels merge wherever they come close", false, true, plain_field},
}};

[[nodiscard]] constexpr const BlendRow& row_of(Blend blend) { return kBlends[static_cast<std::size_t>(blend)]; }
[[nodiscard]] constexpr std::string_view name_of(Blend blend) { return row_of(blend).key; }

[[nodiscard]] inline std::optional<Blend> blend_named(std::string_view key) {
    const auto* found = std::ranges::find(kBlends, key, &BlendRow::key);
    return found == kBlends.end() ? std::nullopt : std::optional(found->blend);
}

// "tree|paper"
[[nodiscard]] inline std::string blend_keys() {
    std::string text;
    for (const BlendRow& row : kBlends) text.append(text.empty() ? "" : "|").append(row.key);
    return text;
}

// "tree: vessels that only press on each other stay apart (default); paper: ..."
[[nodiscard]] inline std::string blend_help() {
    std::string text;
    for (const BlendRow& row : kBlends)
        text.append(text.empty() ? "" : "; ").append(row.key).append(": ").append(row.help);
    return text;
}

} // namespace ramus::mesh
