// Chooses the SIMD instruction set of code that is compiled for several (Highway). By default it is the best that the
// processor has, so numbers differ in their last bits between machines. For equal bits, limit all machines to one set.
#pragma once

#include "core/base/error.h"

#include <string>
#include <vector>

namespace ramus {

inline constexpr const char* kInstructionsVariable = "RAMUS_INSTRUCTIONS"; // of the environment

// Highway's names of the sets that this program was compiled for and this processor has, the best first: AVX3
// (AVX-512), AVX2, SSE4 ... Every processor has the last one.
[[nodiscard]] std::vector<std::string> instruction_sets();

// From this call on no set better than `name` is used. Fails if `name` is not one of instruction_sets(). Call it before
// anything is computed.
[[nodiscard]] Result<void> limit_instructions(const std::string& name);

} // namespace ramus
