// A number scattered over 64 bits.
#pragma once

#include <cstdint>

namespace ramus {

// One to one (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
constexpr std::uint64_t scattered(std::uint64_t number) {
    number = (number + 1) * 0x9e3779b97f4a7c15U;
    number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9U;
    number = (number ^ number >> 27) * 0x94d049bb133111ebU;
    return number ^ number >> 31;
}

} // namespace ramus
