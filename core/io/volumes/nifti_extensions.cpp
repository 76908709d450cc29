#include "core/io/volumes/nifti_extensions.h"

#include "core/io/volumes/label_names.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace ramus::io {

namespace {

std::int32_t size_at(std::string_view bytes, bool swapped) {
    std::array<char, 4> raw{};
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if (swapped) std::ranges::reverse(raw);
    return std::bit_cast<std::int32_t>(raw);
}

} // namespace

std::vector<volume::LabelName> extension_names(std::string_view bytes, bool swapped, std::vector<std::string>& notes) {
    constexpr std::size_t kFlag = 4, kHead = 8; // an extension's size and code
    if (bytes.size() < kFlag || bytes.front() == '\0') return {};
    bytes.remove_prefix(kFlag);
    while (bytes.size() >= kHead) {
        const std::int32_t size = size_at(bytes, swapped);
        // Bytes after the last extension are padding.
        if (size == 0) break;
        if (size < static_cast<std::int32_t>(kHead) || static_cast<std::size_t>(size) > bytes.size()) {
            notes.emplace_back("an extension of its header is damaged, and was left out");
            break;
        }
        std::string_view content = bytes.substr(kHead, static_cast<std::size_t>(size) - kHead);
        bytes.remove_prefix(static_cast<std::size_t>(size));
        content = content.substr(0, content.find('\0'));
        if (content.find("<LabelTable") == std::string_view::npos) continue;
        auto names = label_table_names(content);
        if (!names.empty()) {
            notes.emplace_back("the names of labels are those of its header's extension");
            return names;
        }
        notes.emplace_back("the names of labels in its header's extension are damaged, and were left out");
    }
    return {};
}

} // namespace ramus::io
