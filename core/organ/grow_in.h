// Grows a synthetic tree in the organ of a mask, for tests and measurements in organs of real patients. The method and
// what it guarantees are those of core/tree/grow/grow.h; here every point but the stem's lies in a voxel of the organ.
//
// The stem enters where the surface is nearest to the organ's centroid, as at the hilum of a kidney or a lung, and two
// trunks leave it for the two halves of the organ. Only the largest part of the organ is grown in. Not guaranteed: that
// walls of vessels stay inside to less than a voxel, and distances where the axes of the mask are not at right angles.
#pragma once

#include "core/organ/organ.h"
#include "core/tree/grow/grow.h"

namespace ramus::organ {

// The default options for this organ: as for a liver of 1.5 litres, with the radius of the stem and the spacing of
// points in proportion.
[[nodiscard]] tree::GrowOptions grow_options_for(const Organ& organ);

// Fails as tree::grow() does, and if the organ is too small or too thin for the stem. `organ_width_mm` is not used.
[[nodiscard]] Result<tree::GrownTree> grow_in(const Organ& organ, const tree::GrowOptions& options, Job& job);

} // namespace ramus::organ
