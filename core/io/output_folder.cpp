#include "core/io/output_folder.h"

#include <system_error>

namespace ramus::io {

namespace fs = std::filesystem;

Result<OutputFolder> OutputFolder::make(const fs::path& folder) {
    OutputFolder made(folder);
    std::error_code error;
    std::vector<fs::path> missing; // the innermost first
    for (fs::path one = fs::absolute(folder, error).lexically_normal(); !one.empty() && !fs::exists(one, error);
         one = one.parent_path())
        if (one.has_filename()) missing.push_back(one);
    for (; !missing.empty(); missing.pop_back()) {
        const auto held = hold_leftovers();
        if (fs::create_directory(missing.back(), error)) made.made_.emplace_back(missing.back(), LeftoverKind::kFile);
    }
    if (!fs::is_directory(folder, error))
        return fail("the folder cannot be made", folder.string(), "give the name of a folder");
    return made;
}

OutputFolder::~OutputFolder() {
    while (!made_.empty()) made_.pop_back();
}

} // namespace ramus::io
