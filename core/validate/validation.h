// Validation of a surface against the tree that it is to be of: any surface, whoever made it. The four questions of
// S. Oeltze and B. Preim, "Visualization of Vasculature with Convolution Surfaces: Method, Validation and Evaluation",
// IEEE Transactions on Medical Imaging 24, 2005: are branches lost, are there false ones, are separate branches merged,
// are constrictions right? Two more: are branches as wide as in the tree, and where they are in the tree? And how true
// positions and radii are along the branches. The tree counts as it was read, with all its branches, however the
// surface was smoothed. mm, RAS; deterministic.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/contacts/contacts.h"
#include "core/tree/vessel_tree.h"
#include "core/validate/shape.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::validate {

// A stretch of a branch's centerline that is outside of the surface, or where the surface is less than half as wide as
// the vessel.
struct Lost {
    int branch = 0;
    glm::dvec3 at{0.0}; // its middle, on the centerline
    double length_mm = 0.0;
};

// A part of the surface with no centerline within 1.5 of its radii, that surrounds none, and that is at least as long
// as the vessel beside it is thick: else it is a bulge of the wall.
struct FalsePart {
    glm::dvec3 at{0.0}; // in its middle
    double length_mm = 0.0;
};

// Two vessels that pass each other without a joint, and are one in the surface.
struct Merged {
    std::array<int, 2> branches{}; // ascending; the same twice where a vessel comes back to itself
    glm::dvec3 at{0.0};            // between the two, where they are closest
    double gap_mm = 0.0;           // between their walls there; below 0: they overlap
};

// A narrow place of a branch whose radius in the surface is off by more than 10 %.
struct Constriction {
    int branch = 0;
    glm::dvec3 at{0.0};
    double expected_radius_mm = 0.0, radius_mm = 0.0;
};

// A stretch of a branch that is wider or narrower than in the tree by more than 10 %, as the mean over three radii, and
// no narrow place.
struct Width {
    int branch = 0;
    glm::dvec3 at{0.0};                               // on the centerline, where it is most
    double length_mm = 0.0;                           // of the stretch
    double expected_radius_mm = 0.0, radius_mm = 0.0; // means around the place
};

// A stretch of a branch whose axis in the surface is off its centerline by more than a third of the radius, as the mean
// over three radii.
struct Offset {
    int branch = 0;
    glm::dvec3 at{0.0};     // on the centerline, where it is most
    double length_mm = 0.0; // of the stretch
    double offset_mm = 0.0; // the mean around the place
};

// How well the surface follows the tree.
struct Fidelity {
    std::size_t points = 0, outside = 0; // points that were read; those outside of the surface
    std::size_t places = 0;              // that are alone; 0: the others mean nothing
    double offset_median_mm = 0.0, offset_p95_mm = 0.0, offset_max_mm = 0.0; // of the axis there
};

// What the surface makes of a place on a centerline.
struct RadiusPlace {
    int branch = 0;
    double along_mm = 0.0; // from the branch's first point
    glm::dvec3 at{0.0};
    double input_mm = 0.0;   // radius as it was read
    double surface_mm = 0.0; // radius of a circle as large as the surface's cross-section; 0 outside of the surface
    double flat_mm = 0.0;    // likewise of the flat triangles, which are chords of the surface
    bool alone = false;      // away from joints, ends and other vessels
    glm::dvec3 direction{0.0, 0.0, 1.0}; // of the centerline, unit length
};

// |surface - input| / input over all places that are alone.
struct RadiusError {
    std::size_t places = 0; // 0: none is alone, the others mean nothing
    double median = 0.0, p95 = 0.0;
    double flat_median = 0.0, flat_p95 = 0.0; // of flat_mm
    // Only at inner points that were read, and are alone. Between them the input is taken as linear, which a surface of
    // `Centerline::kSmooth` is not.
    std::size_t points = 0; // 0: the others mean nothing
    double points_median = 0.0, points_p95 = 0.0;
};

struct Validation {
    std::vector<Lost> lost;             // by branch, along each
    std::vector<FalsePart> false_parts; // the longest first
    std::vector<Merged> merged;         // the deepest overlap first
    std::vector<Constriction> constrictions;
    std::vector<Width> widths;     // by branch
    std::vector<Offset> positions; // by branch
    Fidelity fidelity;
    RadiusError radius_error;
    std::optional<Shape> shape;     // for who knows that the surface is closed, and one, to fill in: shape_of()
    std::vector<RadiusPlace> radii; // branch by branch, along each

    // No question is answered by a place.
    [[nodiscard]] bool nothing_found() const {
        return lost.empty() && false_parts.empty() && merged.empty() && constrictions.empty() && widths.empty() &&
               positions.empty();
    }
};

struct ValidationOptions {
    // Of the kernel: how close vessels have to come to count as passing each other.
    tree::ContactLimits limits = tree::limits_of_gaussian(5.0);
    int threads = 0; // 0: all cores
};

// The surface has a triangle at least. Fails when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<Validation> validate(const tree::VesselTree& source, const mesh::TriangleMesh& surface,
                                          const ValidationOptions& options, Job& job);

// The radius of another surface of the same vessels (cones, a mask's isosurface) at the places of `radii`, as
// RadiusPlace::surface_mm. Fails as validate().
[[nodiscard]] Result<std::vector<double>> radii_in(const mesh::TriangleMesh& surface,
                                                   const std::vector<RadiusPlace>& radii,
                                                   const ValidationOptions& options, Job& job);

} // namespace ramus::validate
