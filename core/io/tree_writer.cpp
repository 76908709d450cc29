#include "core/io/tree_writer.h"

#include "core/io/output_file.h"
#include "core/io/swc_writer.h"
#include "core/io/tree_json.h"

#include <algorithm>
#include <cctype>

namespace ramus::io {

namespace {

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

} // namespace

Result<void> check_tree_output(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension != ".swc" && extension != ".json")
        return fail("no tree format has the extension \"" + extension + "\"", file.string(), "use .swc or .json");
    return check_output(file);
}

Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                        const std::vector<std::string>& comments) {
    if (auto possible = check_tree_output(file); !possible) return possible;
    return extension_of(file) == ".swc" ? write_swc(tree, file, comments) : write_tree_json(tree, file);
}

} // namespace ramus::io
