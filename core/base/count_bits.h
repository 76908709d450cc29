// Counts the bits of a word that are set.
#pragma once

#include <cstdint>

namespace ramus {

// Same result as std::popcount(), which becomes a call and a table lookup if the target has no instruction for it.
[[nodiscard]] constexpr std::uint32_t count_bits(std::uint64_t word) {
    word -= word >> 1U & 0x5555555555555555U;
    word = (word & 0x3333333333333333U) + (word >> 2U & 0x3333333333333333U);
    return static_cast<std::uint32_t>(((word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU) * 0x0101010101010101U >> 56U);
}

} // namespace ramus
