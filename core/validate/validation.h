// Validates a surface against its tree. The surface may come from any program. The four questions are from S. Oeltze
// and B. Preim, "Visualization of Vasculature with Convolution Surfaces: Method, Validation and Evaluation", IEEE
// Transactions on Medical Imaging 24, 2005: are branches lost, are there false ones, are separate branches merged, are
// constrictions right? There are two more: are branches as wide as in the tree, and are they where they are in the
// tree? In addition, the errors of positions and radii along the branches are measured. The reference is the tree as it
// was read, with all its branches. Lengths in mm, positions in RAS. The result is deterministic.
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

// A stretch of a branch's centerline outside of the surface, or where the surface is less than half as wide as the
// vessel.
struct Lost {
    int branch = 0;
    glm::dvec3 at{0.0}; // middle of the stretch, on the centerline
    double length_mm = 0.0;
};

// A part of the surface that is farther than 1.5 radii from every centerline, contains no centerline, and is at least
// as long as the radius of the vessel next to it. A shorter part is a bulge of the wall.
struct FalsePart {
    glm::dvec3 at{0.0}; // middle of the part
    double length_mm = 0.0;
};

// Two vessels that pass each other without a joint and are merged in the surface.
struct Merged {
    std::array<int, 2> branches{}; // ascending; equal if a vessel comes back to itself
    glm::dvec3 at{0.0};            // between their closest places
    double gap_mm = 0.0;           // between their walls there; negative: they overlap
};

// A narrow place of a branch at which the radius of the surface differs by more than 10 %.
struct Constriction {
    int branch = 0;
    glm::dvec3 at{0.0};
    double expected_radius_mm = 0.0, radius_mm = 0.0;
};

// A stretch of a branch that is wider or narrower than in the tree by more than 10 %, as the mean over three radii, and
// is no narrow place.
struct Width {
    int branch = 0;
    glm::dvec3 at{0.0};                               // the place of the largest difference, on the centerline
    double length_mm = 0.0;                           // of the stretch
    double expected_radius_mm = 0.0, radius_mm = 0.0; // means around the place
};

// A stretch of a branch whose axis in the surface is more than a third of the radius away from its centerline, as the
// mean over three radii.
struct Offset {
    int branch = 0;
    glm::dvec3 at{0.0};     // the place of the largest offset, on the centerline
    double length_mm = 0.0; // of the stretch
    double offset_mm = 0.0; // mean around the place
};

// How well the surface follows the centerlines.
struct Fidelity {
    std::size_t points = 0, outside = 0; // points of the tree as read; those outside of the surface
    std::size_t places = 0;              // places that are alone; if 0, the offsets are not valid
    double offset_median_mm = 0.0, offset_p95_mm = 0.0, offset_max_mm = 0.0; // of the axis at these places
};

// The radius of the surface at a place on a centerline.
struct RadiusPlace {
    int branch = 0;
    double along_mm = 0.0; // from the branch's first point
    glm::dvec3 at{0.0};
    double input_mm = 0.0; // radius of the tree as read
    double surface_mm =
        0.0;              // radius of a circle with the area of the surface's cross-section; 0 outside of the surface
    double flat_mm = 0.0; // the same for the flat triangles, which are chords of the surface
    bool alone = false;   // away from joints, ends, other vessels and sharp bends
    glm::dvec3 direction{0.0, 0.0, 1.0}; // of the centerline, unit length
};

// |surface - input| / input over all places that are alone.
struct RadiusError {
    std::size_t places = 0; // number of these places; if 0, the errors are not valid
    double median = 0.0, p95 = 0.0;
    double flat_median = 0.0, flat_p95 = 0.0; // for flat_mm
    // Only at inner points of the tree that are alone. Between points the input is interpolated linearly, from which a
    // surface with `Centerline::kSmooth` differs.
    std::size_t points = 0; // number of these points; if 0, the next two are not valid
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
    std::optional<Shape> shape; // validate() leaves it empty; callers fill it in if the surface is closed: shape_of()
    std::vector<RadiusPlace> radii; // branch by branch, along each

    // Whether no question has a finding.
    [[nodiscard]] bool nothing_found() const {
        return lost.empty() && false_parts.empty() && merged.empty() && constrictions.empty() && widths.empty() &&
               positions.empty();
    }
};

struct ValidationOptions {
    // The closenesses at which vessels count as passing each other; those of the kernel.
    tree::ContactLimits limits = tree::limits_of_gaussian(5.0);
    int threads = 0; // 0: all cores
};

// The surface must have at least one triangle. Fails if `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<Validation> validate(const tree::VesselTree& source, const mesh::TriangleMesh& surface,
                                          const ValidationOptions& options, Job& job);

// The radii (RadiusPlace::surface_mm) of another surface of the same vessels (cones, isosurface of a mask) at the
// places of `radii`. Fails if `job` is cancelled.
[[nodiscard]] Result<std::vector<double>> radii_in(const mesh::TriangleMesh& surface,
                                                   const std::vector<RadiusPlace>& radii,
                                                   const ValidationOptions& options, Job& job);

} // namespace ramus::validate
