#pragma once

#include <cstdint>

namespace ramus {

// As std::popcount(), in line: that is a call and a table where a processor need not have an instruction for it.
[[nodiscard]] constexpr std::uint32_t count_bits(std::uint64_t word) {
    word -= word >> 1U & 0x5555555555555555U;
    word = (word & 0x3333333333333333U) + (word >> 2U & 0x3333333333333333U);
    return static_cast<std::uint32_t>(((word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU) * 0x0101010101010101U >> 56U);
}

} // namespace ramus
