// Numbers as they lie in binary files, of any type and either byte order.
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

// The number that begins at `bytes`, which has sizeof(T) of them.
template <class T> [[nodiscard]] T number_at(const char* bytes, std::endian order) {
    char ordered[sizeof(T)];
    std::memcpy(ordered, bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(ordered, ordered + sizeof(T));
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
}

// All whole numbers in `bytes`; what is left over at the end is left out.
[[nodiscard]] std::vector<double> numbers_in(std::string_view bytes, NumberType type, std::endian order);
[[nodiscard]] std::vector<std::int64_t> whole_numbers_in(std::string_view bytes, NumberType type, std::endian order);

// None: a character that is no base64. Blanks are passed over; several texts may follow each other, each with its own
// padding. At most `limit` bytes of result, for those who need only the beginning.
[[nodiscard]] std::optional<std::string> base64_decoded(std::string_view text, std::size_t limit);

[[nodiscard]] std::string base64_encoded(std::string_view bytes);

} // namespace ramus::io
