// splitmix64: a mixing function on 64-bit numbers, for hashes, pseudorandom labels and pseudorandom numbers.
#pragma once

#include <cstdint>

namespace ramus {

// A bijection (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014). Not cryptographic.
inline constexpr std::uint64_t kSplitmixStep = 0x9e3779b97f4a7c15U;
constexpr std::uint64_t splitmix64_of_state(std::uint64_t number) {
    number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9U;
    number = (number ^ number >> 27) * 0x94d049bb133111ebU;
    return number ^ number >> 31;
}
constexpr std::uint64_t splitmix64(std::uint64_t number) { return splitmix64_of_state((number + 1) * kSplitmixStep); }

} // namespace ramus
