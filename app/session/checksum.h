// 64-bit FNV-1a, to detect that something has changed. Detects mistakes, not manipulation.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus::app {

class Checksum {
public:
    Checksum& add(std::string_view bytes) {
        for (const char byte : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
        return *this;
    }
    [[nodiscard]] std::uint64_t number() const { return hash_; }
    [[nodiscard]] std::string text() const { // sixteen hexadecimal digits
        constexpr const char* kDigits = "0123456789abcdef";
        std::string digits(16, '0');
        for (std::size_t i = 0; i < 16; ++i) digits[15 - i] = kDigits[(hash_ >> (4 * i)) & 15];
        return digits;
    }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

} // namespace ramus::app
