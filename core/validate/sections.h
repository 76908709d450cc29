// Cross-sections of a surface at the places of the reference: through the place, and of the vessel itself, which may
// run next to the place if the surface has moved it.
#pragma once

#include "core/base/job.h"
#include "core/validate/probe.h"
#include "core/validate/reference.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::validate {

struct Section {
    CrossSection through; // through the place
    // Whether the vessel was found with at least half of its radius: through the place, or with a middle at most kAside
    // radii away from it. `vessel` is its cross-section.
    bool found = false;
    CrossSection vessel;
};
inline constexpr double kAside = 1.5;

// The cross-sections through the places, up to four radii or twice the largest radius of the branch, since a stenosis
// may be filled to the width next to it. If `job` is cancelled, the remaining sections are empty.
[[nodiscard]] std::vector<CrossSection> cross_sections(const std::vector<Place>& places, const Probe& probe,
                                                       const JobRange& job);
// The sections of the vessels at all places of the reference.
[[nodiscard]] std::vector<Section> sections_of(const Reference& reference, const Probe& probe, const JobRange& job);

// The vector (mm) from the place to the middle of its vessel's cross-section, perpendicular to the vessel. The vessel
// must have been found.
[[nodiscard]] glm::dvec3 offset_of(const Section& section, const Place& place);

} // namespace ramus::validate
