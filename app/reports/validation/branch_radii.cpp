#include "app/reports/validation/branch_radii.h"

#include <functional>

namespace ramus::app {

RadiusCurves curves_of(const ValidatedDataSet& set, const validate::BranchError& branch) {
    RadiusCurves curves;
    for (std::size_t i = branch.first; i < branch.first + branch.count; ++i) {
        const validate::RadiusPlace& place = set.validation.radii[i];
        curves.along_mm.push_back(place.along_mm);
        curves.input_mm.push_back(place.input_mm);
        curves.surface_mm.push_back(place.surface_mm);
        curves.alone.push_back(place.alone);
        if (!set.cones_radii_mm.empty()) curves.cones_mm.push_back(set.cones_radii_mm[i]);
        if (!set.mask_radii_mm.empty()) curves.mask_mm.push_back(set.mask_radii_mm[i]);
    }
    return curves;
}

void write_radii(io::BufferedFile& file, std::span<const ValidatedDataSet> sets, bool numbered) {
    file.write(numbered ? "data_set,branch" : "branch");
    file.write(",along,x,y,z,input_radius,surface_radius,flat_radius,alone,cones_radius,mask_radius,unit\r\n");
    for (std::size_t n = 0; n < sets.size(); ++n) {
        const ValidatedDataSet& set = sets[n];
        for (std::size_t i = 0; i < set.validation.radii.size(); ++i) {
            const validate::RadiusPlace& place = set.validation.radii[i];
            if (numbered) {
                file.write_number(n + 1);
                file.write(",");
            }
            file.write_number(place.branch);
            for (const double value : {place.along_mm, place.at.x, place.at.y, place.at.z, place.input_mm,
                                       place.surface_mm, place.flat_mm}) {
                file.write(",");
                file.write_number(value + 0.0); // no negative zero
            }
            file.write(place.alone ? ",yes" : ",no");
            for (const std::vector<double>& radii : {std::cref(set.cones_radii_mm), std::cref(set.mask_radii_mm)}) {
                file.write(",");
                if (!radii.empty()) file.write_number(radii[i]);
            }
            file.write(",");
            file.write(set.claims.unit_word());
            file.write("\r\n");
        }
    }
}

} // namespace ramus::app
