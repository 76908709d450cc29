// The questions of the validation, one function each. An implementation detail of validate(): use validation.h.
#pragma once

#include "core/validate/probe.h"
#include "core/validate/reference.h"
#include "core/validate/sections.h"
#include "core/validate/validation.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ramus::validate {

// A lost stretch, and its extent along the branch (mm from the first point), with adjacent parts inside other vessels.
struct LostStretch {
    Lost lost;
    double from = 0.0, to = 0.0;
};

// `sections`, here and below: one for each place of the reference.
[[nodiscard]] std::vector<LostStretch> lost_stretches(const Reference& reference, std::span<const Section> sections);

// A joint of a lost branch. The author of the surface may have smoothed the remaining vessel as if there were no joint,
// so within `reach` (mm) it may run elsewhere. That is not reported as another lost or false branch.
struct MovedJoint {
    glm::dvec3 at{0.0};
    double reach = 0.0;
    std::size_t of = 0; // index of the lost stretch
};
[[nodiscard]] std::vector<MovedJoint> moved_joints(const Reference& reference, std::span<const LostStretch> lost);
[[nodiscard]] bool is_moved(std::span<const MovedJoint> joints, const glm::dvec3& at, double length_mm);

// A stretch of a branch whose axis is displaced in the surface; `from` and `to` in mm from the branch's first point.
struct MovedStretch {
    Offset offset;
    double from = 0.0, to = 0.0;
};
[[nodiscard]] std::vector<MovedStretch> moved_stretches(const Reference& reference, const Probe& probe,
                                                        std::span<const Section> sections);
// Whether a place is in or next to a moved stretch.
[[nodiscard]] bool is_moved(std::span<const MovedStretch> moved, const Place& place);

// The wall of a vessel in a moved stretch is not reported as a false part.
[[nodiscard]] std::vector<FalsePart> false_parts(const Reference& reference, const mesh::TriangleMesh& surface,
                                                 std::span<const Section> sections, std::span<const MovedStretch> moved,
                                                 std::span<const LostStretch> lost);

// A lost vessel is not reported as merged.
[[nodiscard]] std::vector<Merged> merged_vessels(const Reference& reference, const Probe& probe,
                                                 const tree::ContactLimits& limits, std::span<const LostStretch> lost);

// Narrow places of the tree or of the surface at which the two radii differ. None in moved stretches.
[[nodiscard]] std::vector<Constriction> changed_constrictions(const Reference& reference,
                                                              std::span<const Section> sections,
                                                              std::span<const MovedStretch> moved);

// Whether a narrow place only seems filled because its section is oblique, as in a sharp bend: tilted sections there
// are as narrow as expected.
[[nodiscard]] bool is_oblique(const Reference& reference, const Probe& probe, const Constriction& found);

// Stretches with a different width. None in moved stretches, where sections are less reliable. If a stretch continues
// on both sides of a narrow place, that place is removed from `constrictions`. Otherwise the narrow place is reported
// instead of the stretch.
[[nodiscard]] std::vector<Width> changed_widths(const Reference& reference, std::span<const Section> sections,
                                                std::span<const MovedStretch> moved,
                                                std::vector<Constriction>& constrictions);

} // namespace ramus::validate
