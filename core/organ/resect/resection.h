// Resection: what a surgeon removes of an organ, as a function over space that is negative (or 0) where tissue is
// removed. A plan has several resections; the union of what they remove is removed.
#pragma once

#include "core/base/bounds.h"
#include "core/organ/resect/dividing_surface.h"
#include "core/organ/resect/sheet.h"
#include "core/organ/resect/voxel_solid.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace ramus::organ {

// Everything to which the normal points is removed.
struct HalfSpace {
    glm::dvec3 point{0.0}, normal{0.0, 0.0, 1.0}; // of unit length
};

// The inside of a closed mesh, the smaller side of an open one; or the other side.
struct SurfaceCut {
    std::shared_ptr<const DividingSurface> surface;
    bool other_side = false;
};

// A set of voxels and everything within a margin around them: a lesion (a wedge), or all voxels that lose their supply
// by cuts. The distance is measured from the voxels' boxes.
struct Around {
    std::shared_ptr<const VoxelSolid> solid;
    double margin_mm = 0.0;
    // By branch of the tree, not 0: the resection goes around the vessel, and does not cut it. Null: there are none.
    std::shared_ptr<const std::vector<std::uint8_t>> spared = nullptr;
};

using Resection = std::variant<HalfSpace, Sheet, SurfaceCut, Around>;

inline constexpr std::size_t kMostResections = 64; // of a plan

// Not above 0: the point is removed. For half spaces, surfaces and margins it is the distance (mm) from the surface of
// the resection; for sheets the height, whose size is not below the distance.
[[nodiscard]] double value_at(const Resection& resection, const glm::dvec3& point);
// Whether a point is removed. Quick for a margin of 0.
[[nodiscard]] bool removes(const Resection& resection, const glm::dvec3& point);
// How fast the value changes at most in a box: by so much for each mm.
[[nodiscard]] double steepest_in(const Resection& resection, const Bounds<glm::dvec3>& box);
// The unit normal of the resection's surface at a point near it, away from what is removed.
[[nodiscard]] glm::dvec3 normal_at(const Resection& resection, const glm::dvec3& point);

// Where the segment from a to b passes from what the resection leaves to what it removes, or back: fractions of the
// segment, ascending, exact to 1e-9 mm. `steepest`: steepest_in() of a box that contains the segment. Two crossings
// within 0.01 mm of each other may be missed.
[[nodiscard]] std::vector<double> crossings_of(const Resection& resection, const glm::dvec3& a, const glm::dvec3& b,
                                               double steepest);

// The place on the segment from a to b where the value is 0; `value_a` and `value_b`, of which one is above 0 and the
// other is not, are the values at its ends. As a fraction of the segment.
[[nodiscard]] double zero_between(const Resection& resection, const glm::dvec3& a, const glm::dvec3& b, double value_a,
                                  double value_b);

} // namespace ramus::organ
