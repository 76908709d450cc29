#include "core/io/trees/tree_format.h"

#include "core/io/trees/swc_reader.h"
#include "core/io/trees/swc_writer.h"
#include "core/io/trees/tree_json.h"

namespace ramus::io {

const std::vector<TreeFormat>& tree_formats() {
    static const std::vector<TreeFormat> table = {
        {{.name = "SWC", .extensions = {".swc"}, .help = "One point a line: id, type, x, y, z, radius, parent."},
         parse_swc,
         write_swc},
        {{.name = "ramus JSON",
          .extensions = {".json"},
          .has_signature = is_tree_json,
          .states_unit = true,
          .states_orientation = true,
          .help = "Points, branches, labels and repairs of any network, without loss."},
         parse_tree_json,
         write_tree_json},
    };
    return table;
}

std::string readable_tree_extensions() { return listed(readable_extensions(tree_formats())); }
std::string writable_tree_extensions() { return listed(writable_extensions(tree_formats())); }

bool names_tree(const std::filesystem::path& path) {
    const TreeFormat* format = format_by_name(tree_formats(), path);
    return format != nullptr && is_read(*format);
}

} // namespace ramus::io
