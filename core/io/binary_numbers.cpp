#include "core/io/binary_numbers.h"

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace ramus::io {

namespace {

template <class To, class From> To as_number(From value) {
    if constexpr (std::is_floating_point_v<From> && !std::is_floating_point_v<To>)
        return std::abs(value) < 9e15 ? static_cast<To>(value) : std::numeric_limits<To>::min();
    else
        return static_cast<To>(value);
}

template <class From, class To> std::vector<To> converted(std::string_view bytes, std::endian order) {
    std::vector<To> values(bytes.size() / sizeof(From));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = as_number<To>(number_at<From>(bytes.data() + i * sizeof(From), order));
    return values;
}

template <class To> std::vector<To> converted(std::string_view bytes, NumberType type, std::endian order) {
    // In the order of NumberType.
    constexpr std::array kAll{converted<std::int8_t, To>,   converted<std::uint8_t, To>,  converted<std::int16_t, To>,
                              converted<std::uint16_t, To>, converted<std::int32_t, To>,  converted<std::uint32_t, To>,
                              converted<std::int64_t, To>,  converted<std::uint64_t, To>, converted<float, To>,
                              converted<double, To>};
    return kAll[static_cast<std::size_t>(type)](bytes, order);
}

constexpr std::uint8_t kNoDigit = 255, kPadding = 254, kBlank = 253;

constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::uint8_t, 256> base64_digits() {
    std::array<std::uint8_t, 256> digits{};
    digits.fill(kNoDigit);
    for (std::size_t d = 0; d < kBase64Digits.size(); ++d)
        digits[static_cast<unsigned char>(kBase64Digits[d])] = static_cast<std::uint8_t>(d);
    digits['='] = kPadding;
    for (const char blank : {' ', '\t', '\r', '\n'}) digits[static_cast<unsigned char>(blank)] = kBlank;
    return digits;
}

} // namespace

std::vector<double> numbers_in(std::string_view bytes, NumberType type, std::endian order) {
    return converted<double>(bytes, type, order);
}

std::vector<std::int64_t> whole_numbers_in(std::string_view bytes, NumberType type, std::endian order) {
    return converted<std::int64_t>(bytes, type, order);
}

std::optional<std::string> base64_decoded(std::string_view text, std::size_t limit) {
    static constexpr std::array<std::uint8_t, 256> kValues = base64_digits();
    std::string bytes;
    bytes.reserve(std::min(limit, text.size() / 4 * 3 + 3));
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    for (const char c : text) {
        const std::uint8_t digit = kValues[static_cast<unsigned char>(c)];
        if (digit == kBlank) continue;
        if (digit == kNoDigit || (digit == kPadding ? digits < 2 : padding > 0)) return std::nullopt;
        bits = bits << 6 | (digit == kPadding ? 0U : digit);
        if (digit == kPadding) ++padding;
        if (++digits < 4) continue;
        for (int byte = 0; byte < 3 - padding && bytes.size() < limit; ++byte)
            bytes += static_cast<char>(bits >> (16 - 8 * byte) & 255U);
        if (bytes.size() >= limit) return bytes;
        bits = 0, digits = 0, padding = 0;
    }
    return digits == 0 ? std::optional(bytes) : std::nullopt;
}

std::string base64_encoded(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t bits = 0;
        for (std::size_t b = 0; b < 3; ++b)
            bits = bits << 8 | (b < count ? static_cast<unsigned char>(bytes[at + b]) : 0U);
        for (std::size_t d = 0; d < 4; ++d) text += d > count ? '=' : kBase64Digits[bits >> (18 - 6 * d) & 63U];
    }
    return text;
}

} // namespace ramus::io
