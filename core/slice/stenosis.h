// stenosis_of(): by how many percent the narrowest section between two places of a path is narrower than a reference
// that a person sets. For each measure, 100 * (1 - least / reference): negative if the vessel is wider everywhere.
//
// The reference is the figures of one place, the mean over a stretch, or a disc of a diameter. Sections that are not
// closed and samples without a section do not count. The figures do not say whether a narrowing matters: near forks and
// at the ends of a vessel sections are not those of the vessel alone (Lumen::shared_with).
#pragma once

#include "core/base/error.h"
#include "core/slice/plane_shape.h"

#include <cstddef>
#include <optional>
#include <span>

namespace ramus::slice {

// The figures of the section at each sample of a path; none where there is no closed section.
using SectionFigures = std::optional<ShapeFigures>;

// The samples from `first` to `last`, both included, in any order.
struct SampleRange {
    std::size_t first = 0, last = 0;
};

// The mean of each figure over a range, without a centroid. Fails if no sample of it has a section.
[[nodiscard]] Result<ShapeFigures> reference_of(std::span<const SectionFigures> sections, const SampleRange& range);

struct Narrowing {
    double percent = 0.0;
    std::size_t sample = 0; // of the least value, the first of equals
};
struct Stenosis {
    Narrowing least_diameter, equivalent_diameter, area;
};

// Fails if no sample of the range has a section, and if the reference has no area.
[[nodiscard]] Result<Stenosis> stenosis_of(std::span<const SectionFigures> sections, const SampleRange& range,
                                           const ShapeFigures& reference);

} // namespace ramus::slice
