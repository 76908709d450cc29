// What a branch's record and a sample's id say beside colour and branch. As in shade.frag and ids.glsl.
#pragma once

#include <cstdint>

namespace ramus::render::record {

inline constexpr std::uint32_t kCalm = 1, kHighlighted = 2, kHovered = 4, kSelected = 8, kLost = 16, kCut = 32,
                               kGlowing = 64, kChanged = 128;

inline constexpr std::uint32_t kLine = 0x80000000U;    // the centerline of that branch
inline constexpr std::uint32_t kSolid = 0x40000000U;   // a lesion, by its number + 1
inline constexpr std::uint32_t kContext = 0x20000000U; // with kSolid: a context mesh instead
inline constexpr std::uint32_t kNumberBits = 0x003fffffU;

} // namespace ramus::render::record
