// Which radii a surface has, one row each: the command line, sessions and commands read them here.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ramus::mesh {

// Those of the tree, sharpened for the kernel (core/field/kernel_radii.h), or what the kernel makes of the tree's, as
// in the paper.
enum class Radii : std::uint8_t { kPlain, kExact };

// In the order of `Radii`.
inline constexpr std::array<std::string_view, 2> kRadii{"plain", "exact"};

[[nodiscard]] constexpr std::string_view name_of(Radii radii) { return kRadii[static_cast<std::size_t>(radii)]; }

} // namespace ramus::mesh
