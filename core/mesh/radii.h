// The table of modes of radii, for the command line, sessions and commands.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ramus::mesh {

// kPlain: the kernel gets the radii of the tree, as in the paper, so the surface's radii deviate where radii change.
// kExact: the kernel gets compensated radii, so that the surface has those of the tree (core/field/kernel_radii.h).
enum class Radii : std::uint8_t { kPlain, kExact };

// In the order of `Radii`.
inline constexpr std::array<std::string_view, 2> kRadii{"plain", "exact"};

[[nodiscard]] constexpr std::string_view name_of(Radii radii) { return kRadii[static_cast<std::size_t>(radii)]; }

} // namespace ramus::mesh
