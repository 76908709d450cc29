#include "core/io/file_format.h"

#include <algorithm>

namespace ramus::io {

std::size_t extension_length(const std::filesystem::path& path, const FileFormat& format) {
    std::string name = path.filename().string();
    std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    std::size_t longest = 0;
    for (const std::string_view extension : format.extensions)
        if (name.size() > extension.size() && name.ends_with(extension)) longest = std::max(longest, extension.size());
    return longest;
}

std::string listed(const std::vector<std::string_view>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 < words.size() ? ", " : " or ";
        text += words[i];
    }
    return text;
}

} // namespace ramus::io
