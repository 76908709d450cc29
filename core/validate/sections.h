// What a surface has at each place of the reference: the cross-section through the place, and the vessel itself, which
// may run beside its place where the surface has moved it.
#pragma once

#include "core/base/job.h"
#include "core/validate/probe.h"
#include "core/validate/reference.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::validate {

struct Section {
    CrossSection through; // the place
    // The vessel is there, at least half as wide as it should be: through its place, or aside of it. Its cross-section
    // is `vessel`, whose middle is no farther from the place than kAside radii.
    bool found = false;
    CrossSection vessel;
};
inline constexpr double kAside = 1.5;

// Across the places, no farther than four radii or twice the widest radius of the branch: a stenosis may be filled to
// the width beside it. Fewer than there are places where `job` was cancelled.
[[nodiscard]] std::vector<CrossSection> cross_sections(const std::vector<Place>& places, const Probe& probe,
                                                       const JobRange& job);
// With the vessels. Likewise.
[[nodiscard]] std::vector<Section> sections_of(const Reference& reference, const Probe& probe, const JobRange& job);

// From the place to the middle of its vessel's cross-section, across the vessel; mm. The vessel is found.
[[nodiscard]] glm::dvec3 offset_of(const Section& section, const Place& place);

} // namespace ramus::validate
