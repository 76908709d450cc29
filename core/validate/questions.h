// The four questions, one function each. validation.h is for use.
#pragma once

#include "core/validate/probe.h"
#include "core/validate/reference.h"
#include "core/validate/validation.h"

#include <functional>
#include <span>
#include <vector>

namespace ramus::validate {

// `sections`: what the probe says of each of the reference's places.
[[nodiscard]] std::vector<Lost> lost_stretches(const Reference& reference, const Probe& probe,
                                               std::span<const CrossSection> sections);

[[nodiscard]] std::vector<FalsePart> false_parts(const Reference& reference, const mesh::TriangleMesh& surface);

[[nodiscard]] std::vector<Merged> merged_vessels(const Reference& reference, const Probe& probe, double width);

// Narrow places by `expected(place)`, where `actual(place)` is another radius; places by number.
using RadiusAt = std::function<double(std::size_t)>;
[[nodiscard]] std::vector<Constriction> changed_constrictions(const Reference& reference, const RadiusAt& expected,
                                                              const RadiusAt& actual);

// Whether a narrow place that the surface seems to have filled was only cut askew, as in a sharp bend: another section
// through it is as narrow as it should be.
[[nodiscard]] bool is_oblique(const Reference& reference, const Probe& probe, const Constriction& place);

} // namespace ramus::validate
