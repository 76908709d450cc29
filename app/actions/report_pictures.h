// The pictures of a report's page.
#pragma once

#include "app/actions/action.h"
#include "app/reports/report_page.h"

#include <glm/vec2.hpp>

namespace ramus::app::actions {

// On white, for paper: the view as it is in `shape`, so that nothing visible is cropped; everything visible from the
// front and from the left; and each plan of an operation before and after it, all from the view's direction and at one
// scale; and slices (slice_pictures.h). Requires a picture host that draws. `finer`: pixels across each pixel that a
// screen needs; more for print.
[[nodiscard]] Result<ReportPictures> take_report_pictures(ActionContext& context, glm::ivec2 shape, int finer = 1);

} // namespace ramus::app::actions
