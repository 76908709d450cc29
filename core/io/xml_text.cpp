#include "core/io/xml_text.h"

#include <algorithm>

namespace ramus::io {

Result<void> check_xml(std::string_view text, const std::string& name) {
    constexpr std::size_t kNode = 64, kAttribute = 40; // pugixml's, on 64 bits
    std::size_t bytes = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] < '<' || text[at] > '>') continue;
        if (text[at] == '=') {
            bytes += kAttribute;
        } else if (text[at] == '<') {
            if (!text.substr(at + 1).starts_with('/')) bytes += kNode;
        } else { // text between elements is a node, unless it is blank
            const std::size_t next = std::min(text.find_first_not_of(" \t\r\n", at + 1), text.size());
            if (next < text.size() && text[next] != '<') bytes += kNode;
            at = next - 1;
        }
    }
    if (bytes <= std::max(kMostXmlBytes, kMostXmlGrowth * text.size())) return {};
    return fail("its elements would take " + std::to_string(bytes >> 20) +
                    " MiB of memory, more than ten times its text",
                name, "no file of this kind has as many; check the program that wrote it");
}

LineIndex::LineIndex(std::string_view text) : text_(text) {
    std::size_t lines = 0;
    for (std::size_t at = 0; at < text.size(); at += kBlock) {
        before_.push_back(lines);
        lines += static_cast<std::size_t>(std::ranges::count(text.substr(at, kBlock), '\n'));
    }
}

std::size_t LineIndex::line(std::size_t offset) const {
    if (before_.empty()) return 1;
    const std::size_t block = std::min(offset / kBlock, before_.size() - 1), begin = block * kBlock;
    const std::string_view part = text_.substr(begin, std::max(offset, begin) - begin);
    return 1 + before_[block] + static_cast<std::size_t>(std::ranges::count(part, '\n'));
}

} // namespace ramus::io
