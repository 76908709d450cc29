// Text of XML before pugixml makes a document of it: how much memory that takes, and where its lines are.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// What a document may take in memory whatever its text is, and how often its text where that is more. Trees take five
// to eight times their text; `<a/>`, four characters, is 64 bytes as an element.
inline constexpr std::size_t kMostXmlBytes = std::size_t{128} << 20;
inline constexpr std::size_t kMostXmlGrowth = 10;

// Fails where a document would take more.
[[nodiscard]] Result<void> check_xml(std::string_view text, const std::string& name);

// The line of any place in a text, in a time that does not depend on how long the text is, and in little memory.
class LineIndex {
public:
    LineIndex() = default;
    explicit LineIndex(std::string_view text);                // which must outlive this
    [[nodiscard]] std::size_t line(std::size_t offset) const; // from 1

private:
    static constexpr std::size_t kBlock = 256; // bytes
    std::string_view text_;
    std::vector<std::size_t> before_; // by block: lines that end before it
};

} // namespace ramus::io
