// The questions, one function each. validation.h is for use.
#pragma once

#include "core/validate/probe.h"
#include "core/validate/reference.h"
#include "core/validate/sections.h"
#include "core/validate/validation.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ramus::validate {

// A lost stretch, and how far along its branch it may go on within other vessels, in mm from the first point.
struct LostStretch {
    Lost lost;
    double from = 0.0, to = 0.0;
};

// `sections`, here and below: one of each of the reference's places.
[[nodiscard]] std::vector<LostStretch> lost_stretches(const Reference& reference, std::span<const Section> sections);

// A joint from which a branch is lost: whoever made the surface may have smoothed what remains as if there were no
// joint, so that it runs elsewhere within `reach`. That is no other branch, lost or false.
struct MovedJoint {
    glm::dvec3 at{0.0};
    double reach = 0.0;
    std::size_t of = 0; // the stretch, by its number
};
[[nodiscard]] std::vector<MovedJoint> moved_joints(const Reference& reference, std::span<const LostStretch> lost);
[[nodiscard]] bool is_moved(std::span<const MovedJoint> joints, const glm::dvec3& at, double length_mm);

// A stretch of a branch that is elsewhere, in mm from the branch's first point.
struct MovedStretch {
    Offset offset;
    double from = 0.0, to = 0.0;
};
[[nodiscard]] std::vector<MovedStretch> moved_stretches(const Reference& reference, const Probe& probe,
                                                        std::span<const Section> sections);
// Whether a place is in one of them, or next to it.
[[nodiscard]] bool is_moved(std::span<const MovedStretch> moved, const Place& place);

// `moved`: the wall around a vessel that is elsewhere is no other vessel's.
[[nodiscard]] std::vector<FalsePart> false_parts(const Reference& reference, const mesh::TriangleMesh& surface,
                                                 std::span<const Section> sections, std::span<const MovedStretch> moved,
                                                 std::span<const LostStretch> lost);

// `lost`: a vessel that is not there is merged with no other.
[[nodiscard]] std::vector<Merged> merged_vessels(const Reference& reference, const Probe& probe,
                                                 const tree::ContactLimits& limits, std::span<const LostStretch> lost);

// Narrow places of the tree or of the surface, where the radius of the other is not the same. None where the vessel is
// elsewhere.
[[nodiscard]] std::vector<Constriction> changed_constrictions(const Reference& reference,
                                                              std::span<const Section> sections,
                                                              std::span<const MovedStretch> moved);

// Whether a narrow place that the surface seems to have filled was only cut askew, as in a sharp bend: other sections
// there are as narrow as they should be.
[[nodiscard]] bool is_oblique(const Reference& reference, const Probe& probe, const Constriction& found);

// Stretches of another width. Of those that are moved nothing is said: a section from aside is less sure. Where the
// stretch goes on to both sides of a narrow place, that place is taken out of `constrictions`; other narrow places
// stand for the stretch.
[[nodiscard]] std::vector<Width> changed_widths(const Reference& reference, std::span<const Section> sections,
                                                std::span<const MovedStretch> moved,
                                                std::vector<Constriction>& constrictions);

} // namespace ramus::validate
