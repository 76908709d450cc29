#include "core/io/trees/tree_file.h"

#include "core/io/input_file.h"
#include "core/io/output_file.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_json.h"
#include "core/io/volumes/volume_file.h"

namespace ramus::io {

namespace {

tl::unexpected<Error> is_a_volume(const std::string& name) {
    return fail("this is a volume, where a vessel tree is needed", name,
                "ramus mesh --method iso makes the surface of a mask");
}

Result<tree::VesselTree> read_any(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string name = path.string();
    // By its name, before gigabytes are read for nothing.
    if (format_by_name(tree_formats(), path) == nullptr && names_volume(path)) {
        if (auto possible = check_input(path); !possible) return tl::unexpected(possible.error());
        return is_a_volume(name);
    }
    // What is wrong with the file itself comes before what is wrong with its name.
    RAMUS_TRY(text, read_file(path));
    const TreeFormat* format = find_format(tree_formats(), text, path);
    if (format != nullptr && is_read(*format)) return format->parse(text, name, options);
    if (find_format(volume_formats(), text, path) != nullptr) return is_a_volume(name);
    return fail("files of type '" + path.extension().string() + "' cannot be read", name,
                "use " + readable_tree_extensions());
}

const TreeFormat* written_format(const std::filesystem::path& file) {
    const TreeFormat* format = format_by_name(tree_formats(), file);
    return format != nullptr && is_written(*format) ? format : nullptr;
}

} // namespace

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

Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options) {
    auto tree = read_any(path, options);
    if (tree && tree->source.empty()) tree->source = path.filename().string();
    return tree;
}

Result<void> check_tree_output(const std::filesystem::path& file) {
    if (written_format(file) == nullptr)
        return fail("no tree format has the extension \"" + file.extension().string() + "\"", file.string(),
                    "use " + writable_tree_extensions());
    return check_output(file);
}

Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                        const std::vector<std::string>& comments) {
    if (auto possible = check_tree_output(file); !possible) return possible;
    return written_format(file)->write(tree, file, comments);
}

} // namespace ramus::io
