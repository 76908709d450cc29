// The report as one web page that needs nothing beside it: pictures are inside, it prints on paper, and whatever comes
// from files or people is escaped. No GL: who has pictures gives them.
#pragma once

#include "app/reports/html.h"
#include "app/session/document.h"

#include <string>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

struct ReportHead {
    std::string made;      // when
    std::string case_line; // what a person typed to say which case the report is of; may be empty
};

// UTF-8. The first picture is the large one. The document has a tree, and the assets are up to it.
[[nodiscard]] std::string report_page(const Document& document, const Assets& assets,
                                      const std::vector<ReportPicture>& pictures, const ReportHead& head);

} // namespace ramus::app
