// Separation: walls between vessels that touch and are not connected, in one brick of the octree. A field that keeps
// no vessels apart has none (BrickField::separation() in brick_field.h).
//
// A wall lies within what is inside of the sum of both vessels, so that the isovalue does not show it. Every point
// inside has an owner instead, one of the segments that reach it, and a wall runs between two points whose owners are
// apart. Owners of a point are the same whichever brick is asked.
#pragma once

#include "core/field/brick_field.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace ramus::field {

// Of a point inside the surface: the segment that it belongs to, by its number in the field. Two such segments may be
// parts of vessels that are kept apart, with a wall between them however their tubes overlap.
using Owner = std::int32_t;
inline constexpr Owner kNoOwner = -1;

// How far apart the two sides of a wall are at their vertices, in radii of the thinner vessel. Where the wall is bent
// their triangles come nearer to each other, and where they meet, core/mesh/untangle parts them.
inline constexpr double kWallRadii = 0.02;

// A point of a vessel's surface beside a contact, as a picture shows it: where vessels that are kept apart overlap,
// each goes on along its own surface, and what is nearer to the eye makes a crease.
struct DrawnPoint {
    enum class Place : std::uint8_t {
        kOwn,     // on the vessel's own surface
        kCovered, // on that, within another vessel
        kWall,    // on a wall, or on what an obstacle cuts off
    };
    glm::vec3 at{0.0F}; // mm
    glm::vec3 normal{0.0F};
    Place place = Place::kOwn;
};

// A point to be moved onto the surface of one vessel.
struct OwnedGuess {
    std::uint32_t guess = 0; // in a Projection
    Owner owner = kNoOwner;  // of that vessel
    // Where it stays, in a box relative to the brick's corner, in mm: kFree, where it was, if nothing is kept apart
    // there, else within its reach and the box; kBox, in the box, which may be flat.
    enum class Place : std::uint8_t { kFree, kBox };
    Place place = Place::kFree;
    glm::vec3 lower{std::numeric_limits<float>::lowest()}, upper{std::numeric_limits<float>::max()};
};

// Counts returned: kernels evaluated, one for each segment and point.
class Separation {
public:
    virtual ~Separation() = default;
    // Owners of points that are inside.
    virtual std::uint64_t find_owners(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                      std::span<Owner> owners) = 0;
    // The number of the piece of a vessel that an owner belongs to; -1: it is apart from nothing.
    [[nodiscard]] virtual int piece_of(Owner owner) const = 0;
    [[nodiscard]] virtual bool apart_pieces(int a, int b) const = 0;
    [[nodiscard]] bool apart(Owner a, Owner b) const { return a != b && apart_pieces(piece_of(a), piece_of(b)); }
    // Whether vessels are kept apart at a point or near it; relative to the brick's corner, mm.
    [[nodiscard]] virtual bool beside_contact(const glm::vec3& at) = 0;
    // A point of a vessel's surface near a contact, within the guess's box. A point on a wall moves on to the vessel's
    // own surface if that is no farther than `onward` mm. 0: the point is of a mesh whose rims overlap, and on the
    // vessel's own surface if it is near that.
    [[nodiscard]] virtual DrawnPoint draw(const OwnedGuess& whose, const glm::vec3& guess, float onward) = 0;
    // After BrickField::project(): moves those points again whose vessel is near another one that it is kept apart
    // from. Points that stay kFree and have no owner may be left out.
    virtual std::uint64_t project_apart(const Projection& guesses, std::span<const OwnedGuess> owned,
                                        const SurfacePoints& to) = 0;
};

} // namespace ramus::field
