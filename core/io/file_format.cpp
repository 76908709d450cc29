#include "core/io/file_format.h"

#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::io {

std::filesystem::path without_gz(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) == ".gz" ? std::filesystem::path(path).replace_extension() : path;
}

std::size_t extension_length(const std::filesystem::path& path, const FileFormat& format) {
    const std::string name = lower_case(path.filename().string());
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
