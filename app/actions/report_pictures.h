// The pictures of a report's page.
#pragma once

#include "app/actions/action.h"
#include "app/reports/report_page.h"

#include <cstddef>
#include <glm/vec2.hpp>

namespace ramus::app::actions {

// On white, for paper: the view as it is in `shape`, so that nothing visible is cropped; everything visible from the
// front and from the left; and each plan of an operation before and after it, all from the view's direction and at one
// scale; slices (slice_pictures.h); and the first saved views. Requires a picture host that draws. `finer`: pixels
// across each pixel that a screen needs; more for print.
inline constexpr std::size_t kMostPicturedViews = 6; // so that tables are not pages away
[[nodiscard]] Result<ReportPictures> take_report_pictures(ActionContext& context, glm::ivec2 shape, int finer = 1);

} // namespace ramus::app::actions
