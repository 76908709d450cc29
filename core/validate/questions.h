// The four questions, one function each. validation.h is for use.
#pragma once

#include "core/validate/probe.h"
#include "core/validate/reference.h"
#include "core/validate/validation.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace ramus::validate {

// A lost stretch, and how far along its branch it may go on within other vessels, in mm from the first point.
struct LostStretch {
    Lost lost;
    double from = 0.0, to = 0.0;
};

// `sections`: what the probe says of each of the reference's places.
[[nodiscard]] std::vector<LostStretch> lost_stretches(const Reference& reference, const Probe& probe,
                                                      std::span<const CrossSection> sections);

// A joint from which a branch is lost: smoothing moved it in the surface as if it were none, so that what remains runs
// elsewhere within `reach`. That is no other branch, lost or false.
struct MovedJoint {
    glm::dvec3 at{0.0};
    double reach = 0.0;
    std::size_t of = 0; // the stretch, by its number
};
[[nodiscard]] std::vector<MovedJoint> moved_joints(const Reference& reference, std::span<const LostStretch> lost);
[[nodiscard]] bool is_moved(std::span<const MovedJoint> joints, const glm::dvec3& at, double length_mm);

[[nodiscard]] std::vector<FalsePart> false_parts(const Reference& reference, const mesh::TriangleMesh& surface,
                                                 std::span<const LostStretch> lost);

// `lost`: a vessel that is not there is merged with no other.
[[nodiscard]] std::vector<Merged> merged_vessels(const Reference& reference, const Probe& probe,
                                                 const tree::ContactLimits& limits, std::span<const LostStretch> lost);

// Narrow places by `expected(place)`, where `actual(place)` is another radius; places by number.
using RadiusAt = std::function<double(std::size_t)>;
[[nodiscard]] std::vector<Constriction> changed_constrictions(const Reference& reference, const RadiusAt& expected,
                                                              const RadiusAt& actual);

// Whether a narrow place that the surface seems to have filled was only cut askew, as in a sharp bend: other sections
// there are as narrow as they should be.
[[nodiscard]] bool is_oblique(const Reference& reference, const Probe& probe, const Constriction& found);

} // namespace ramus::validate
