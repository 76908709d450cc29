// Estimates the memory of an XML document before pugixml parses it, and finds line numbers.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Most memory of a document: kMostXmlBytes, or kMostXmlGrowth times its text if that is more. Files of trees take five
// to eight times their text; but `<a/>`, four characters, takes 64 bytes.
inline constexpr std::size_t kMostXmlBytes = std::size_t{128} << 20;
inline constexpr std::size_t kMostXmlGrowth = 10;

// Fails if the document would take more memory than allowed.
[[nodiscard]] Result<void> check_xml(std::string_view text, const std::string& name);

// Finds the line number of any offset in a text in constant time. Takes 8 bytes for each 256 bytes of text.
class LineIndex {
public:
    LineIndex() = default;
    explicit LineIndex(std::string_view text);                // `text` must outlive this
    [[nodiscard]] std::size_t line(std::size_t offset) const; // counted from 1

private:
    static constexpr std::size_t kBlock = 256; // bytes
    std::string_view text_;
    std::vector<std::size_t> before_; // by block: number of lines that end before it
};

} // namespace ramus::io
