// The plans of an operation in a report: a printed page for each, and one on which they are compared.
#pragma once

#include "app/reports/html.h"
#include "app/session/document.h"

#include <string>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Empty without an organ that is divided. `pictures`: by plan, before and after; may be empty.
[[nodiscard]] std::string plans_html(const Document& document, const Assets& assets,
                                     const std::vector<std::vector<ReportPicture>>& pictures);

} // namespace ramus::app
