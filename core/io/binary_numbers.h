// Decodes numbers of binary files, of any type and either byte order, and base64.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

enum class NumberType : std::uint8_t {
    kInt8,
    kUInt8,
    kInt16,
    kUInt16,
    kInt32,
    kUInt32,
    kInt64,
    kUInt64,
    kFloat,
    kDouble
};

[[nodiscard]] constexpr std::size_t size_of(NumberType type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

// What processes of one machine tell each other, in its byte order: appends a number.
template <class T> void append_number(std::string& bytes, const T& number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(T));
}
// Removes a number from the front. None: there are too few bytes.
template <class T> [[nodiscard]] std::optional<T> take_number(std::string_view& bytes) {
    if (bytes.size() < sizeof(T)) return std::nullopt;
    T number{};
    std::memcpy(&number, bytes.data(), sizeof(T));
    bytes.remove_prefix(sizeof(T));
    return number;
}

// Decodes the number at `bytes`, which must have sizeof(T) bytes.
template <class T> [[nodiscard]] T number_at(const char* bytes, std::endian order) {
    char ordered[sizeof(T)];
    std::memcpy(ordered, bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(ordered, ordered + sizeof(T));
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
}

// Decodes all numbers in `bytes`. Ignores bytes at the end that are less than a number. In whole_numbers_in(), a float
// or double of 9e15 or more, or NaN, becomes the smallest std::int64_t; other fractions are truncated.
[[nodiscard]] std::vector<double> numbers_in(std::string_view bytes, NumberType type, std::endian order);
[[nodiscard]] std::vector<std::int64_t> whole_numbers_in(std::string_view bytes, NumberType type, std::endian order);

// Decodes base64. Skips blanks; several texts may follow each other, each with its own padding. Stops after `limit`
// decoded bytes. None: the text is no base64.
[[nodiscard]] std::optional<std::string> base64_decoded(std::string_view text, std::size_t limit);

[[nodiscard]] std::string base64_encoded(std::string_view bytes);

} // namespace ramus::io
