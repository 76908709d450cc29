#include "core/slice/stenosis.h"

#include "core/base/infinity.h"

#include <algorithm>

namespace ramus::slice {

namespace {

// Calls `call(sample, figures)` for the samples of a range that have a section; fails without any.
template <class Call>
Result<void> for_sections(std::span<const SectionFigures> sections, const SampleRange& range, const Call& call) {
    bool any = false;
    for (std::size_t n = std::min(range.first, range.last); n <= std::max(range.first, range.last); ++n)
        if (n < sections.size() && sections[n]) call(n, *sections[n]), any = true;
    if (any) return {};
    return fail("the vessel has no closed section there", {}, "choose places where a surface encloses the centerline");
}

} // namespace

Result<ShapeFigures> reference_of(std::span<const SectionFigures> sections, const SampleRange& range) {
    ShapeFigures sum;
    double count = 0.0;
    auto found = for_sections(sections, range, [&](std::size_t, const ShapeFigures& one) {
        sum.area_mm2 += one.area_mm2;
        sum.equivalent_mm += one.equivalent_mm;
        sum.least_mm += one.least_mm;
        sum.largest_mm += one.largest_mm;
        count += 1.0;
    });
    if (!found) return tl::unexpected(found.error());
    return ShapeFigures{
        sum.area_mm2 / count, sum.equivalent_mm / count, sum.least_mm / count, sum.largest_mm / count, {}};
}

Result<Stenosis> stenosis_of(std::span<const SectionFigures> sections, const SampleRange& range,
                             const ShapeFigures& reference) {
    if (!(reference.area_mm2 > 0.0) || !(reference.least_mm > 0.0))
        return fail("the reference of the stenosis has no area", {}, "choose another place, or state a diameter");
    const auto narrowing = [&](double ShapeFigures::*figure) -> Result<Narrowing> {
        double least = kInfinity;
        Narrowing found;
        auto any = for_sections(sections, range, [&](std::size_t n, const ShapeFigures& one) {
            if (one.*figure < least) least = one.*figure, found.sample = n;
        });
        if (!any) return tl::unexpected(any.error());
        found.percent = 100.0 * (1.0 - least / reference.*figure);
        return found;
    };
    RAMUS_TRY(least, narrowing(&ShapeFigures::least_mm));
    RAMUS_TRY(equivalent, narrowing(&ShapeFigures::equivalent_mm));
    RAMUS_TRY(area, narrowing(&ShapeFigures::area_mm2));
    return Stenosis{least, equivalent, area};
}

} // namespace ramus::slice
