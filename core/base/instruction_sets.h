// Code that is compiled for several instruction sets runs with the best that the processor has. Numbers then differ in
// their last bits from one machine to another; who wants the same bits names a set that all of them have.
#pragma once

#include "core/base/error.h"

#include <string>
#include <vector>

namespace ramus {

inline constexpr const char* kInstructionsVariable = "RAMUS_INSTRUCTIONS"; // of the environment

// Highway's names of those that this program was compiled for and this processor has, the best first: AVX3 (AVX-512),
// AVX2, SSE4 ... The last one every processor has.
[[nodiscard]] std::vector<std::string> instruction_sets();

// From here on nothing better than this one is used. Fails where it is not one of instruction_sets(). To be called
// before anything is computed.
[[nodiscard]] Result<void> limit_instructions(const std::string& name);

} // namespace ramus
