// Slices for a report's page: three through each place that a plan is about.
#pragma once

#include "app/actions/action.h"
#include "app/reports/report_page.h"

#include <vector>

namespace ramus::app::actions {

// A row of an axial, a coronal and a sagittal slice at each lesion, cut, resection and pin, and at the crosshair if it
// was placed: 150 mm across, at most kMostSliceRows rows. None without a scan that is shown.
// Before them, the vessel that slices follow: the picture along it, and sections at its narrowest place and at the
// current one.
// `finer`: as for take_report_pictures().
[[nodiscard]] Result<std::vector<SliceRow>> take_slices(ActionContext& context, int finer = 1);
inline constexpr std::size_t kMostSliceRows = 24; // a page with more takes tens of megabytes

} // namespace ramus::app::actions
