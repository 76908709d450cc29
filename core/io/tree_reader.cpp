#include "core/io/tree_reader.h"

#include "core/io/swc.h"
#include "core/io/tree_json.h"
#include "core/volume/read_volume.h"

#include <algorithm>
#include <cctype>

namespace ramus::io {

namespace {

Result<tree::VesselTree> read_by_extension(const std::filesystem::path& path, const ReadOptions& options) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".swc") return read_swc(path, options);
    if (extension == ".json") return read_tree_json(path, options);
    if (volume::names_volume(path)) {
        if (auto possible = check_input(path); !possible) return tl::unexpected(possible.error());
        return fail("this is a volume, where a vessel tree is needed", path.string(),
                    "ramus mesh --method iso makes the surface of a mask");
    }
    // What is wrong with the file itself comes before what is wrong with its name.
    if (const auto text = read_file(path, std::uintmax_t{4} << 30); !text) return tl::unexpected(text.error());
    return fail("files of type '" + extension + "' cannot be read", path.string(), "use .swc or ramus's own .json");
}

} // namespace

Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options) {
    auto tree = read_by_extension(path, options);
    if (tree && tree->source.empty()) tree->source = path.filename().string();
    return tree;
}

} // namespace ramus::io
