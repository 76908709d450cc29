// Writes the report of a document as a self-contained web page that can be printed. Text from files and people is
// escaped. No GL: the caller provides the pictures.
#pragma once

#include "app/reports/html.h"
#include "app/session/document.h"

#include <string>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Slices of the scan through one place.
struct SliceRow {
    std::string title;
    std::vector<ReportPicture> pictures;
};

struct ReportPictures {
    std::vector<ReportPicture> general;              // the first is large
    std::vector<std::vector<ReportPicture>> plans{}; // by plan of the session: before and after; may be empty
    std::vector<SliceRow> slices{};
    std::vector<ReportPicture> saved_views{}; // of the first saved views of the session, with their names
};

struct ReportHead {
    std::string made;      // time
    std::string case_line; // the user's description of the case; may be empty
};

// Returns UTF-8. The document must have a tree, and the assets must be complete.
[[nodiscard]] std::string report_page(const Document& document, const Assets& assets, const ReportPictures& pictures,
                                      const ReportHead& head);

} // namespace ramus::app
