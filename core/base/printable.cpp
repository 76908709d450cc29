#include "core/base/printable.h"

#include <cstddef>

namespace ramus {

namespace {

bool is_continuation(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

// The number of bytes of a character with this first byte; 0: no character begins with it.
std::size_t length_of(unsigned char first) {
    if (first < 0x80) return 1;
    if (first < 0xC2 || first > 0xF4) return 0;
    return first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

void spell(unsigned char byte, std::string& into) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    into += "\\u00";
    into += kDigits[byte >> 4U];
    into += kDigits[byte & 15U];
}

std::string made_printable(std::string_view text, std::string_view kept) {
    std::string made;
    made.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
        const unsigned char first = byte(0);
        std::size_t length = length_of(first);
        for (std::size_t k = 1; k < length; ++k)
            if (at + k >= text.size() || !is_continuation(byte(k))) length = 0;
        const bool control = first < 0x20 || first == 0x7F;
        if (length == 2 && first == 0xC2 && byte(1) < 0xA0)
            spell(byte(1), made);
        else if (length > 0 && (!control || kept.find(text[at]) != std::string_view::npos))
            made += text.substr(at, length);
        else
            spell(first, made);
        at += length > 0 ? length : 1;
    }
    return made;
}

} // namespace

std::string printable(std::string_view text) { return made_printable(text, {}); }
std::string printable_lines(std::string_view text) { return made_printable(text, "\n\t"); }

} // namespace ramus
