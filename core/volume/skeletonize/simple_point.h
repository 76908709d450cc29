// is_simple(): whether a voxel can be removed from a set without changing its pieces, tunnels and cavities (G.
// Bertrand, G. Malandain, "A new characterization of three-dimensional simple points", 1994). That is so if its
// neighbours in the set are connected, and so are the outside voxels next to it. Uses flood fills on words of 27 bits.
#pragma once

#include "core/volume/skeletonize/voxel_set.h"

namespace ramus::volume {

namespace simple_point {

// Masks of a neighbourhood: the nine bits with x = 0 and so on.
inline constexpr Neighbourhood kFirstX = 0b001001001'001001001'001001001U, kLastX = kFirstX << 2U;
inline constexpr Neighbourhood kFirstY = 0b000000111'000000111'000000111U, kLastY = kFirstY << 6U;
inline constexpr Neighbourhood kFaces = 1U << 4U | 1U << 10U | 1U << 12U | 1U << 14U | 1U << 16U | 1U << 22U;
inline constexpr Neighbourhood kCorners =
    1U << 0U | 1U << 2U | 1U << 6U | 1U << 8U | 1U << 18U | 1U << 20U | 1U << 24U | 1U << 26U;
inline constexpr Neighbourhood kFacesAndEdges = kNeighbours & ~kCorners;

constexpr Neighbourhood along_x(Neighbourhood n) { return n | (n & ~kLastX) << 1U | (n & ~kFirstX) >> 1U; }
constexpr Neighbourhood along_y(Neighbourhood n) { return n | (n & ~kLastY) << 3U | (n & ~kFirstY) >> 3U; }
constexpr Neighbourhood along_z(Neighbourhood n) { return (n | n << 9U | n >> 9U) & (kNeighbours | 1U << kCentreBit); }

} // namespace simple_point

// `around`: the neighbourhood of the voxel in the set; the voxel's own bit does not matter.
[[nodiscard]] constexpr bool is_simple(Neighbourhood around) {
    using namespace simple_point;
    const Neighbourhood inside = around & kNeighbours;
    if (inside == 0) return false;
    Neighbourhood piece = inside & (0U - inside);
    while (true) { // by faces, edges and corners
        const Neighbourhood grown = along_z(along_y(along_x(piece))) & inside;
        if (grown == piece) break;
        piece = grown;
    }
    if (piece != inside) return false;
    const Neighbourhood outside = ~around & kFacesAndEdges;
    const Neighbourhood near = outside & kFaces;
    if (near == 0) return false;
    piece = near & (0U - near);
    while (true) { // by faces
        const Neighbourhood grown = (along_x(piece) | along_y(piece) | along_z(piece)) & outside;
        if (grown == piece) break;
        piece = grown;
    }
    return (piece & near) == near;
}

} // namespace ramus::volume
