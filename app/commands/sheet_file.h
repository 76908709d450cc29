// Reads sheets of resections: a JSON object with a control grid or a contour, or a text file with the points of a
// contour.
//
// JSON: {"contour": [[x, y, z], ...], "control_points": [8, 8]} (the second is optional), or {"origin": [x, y, z],
// "u": [...], "v": [...], "step": [a, b], "size": [m, n], "heights": [...]} as in organ::Sheet, along u fastest; what
// lies on the side of cross(u, v) is removed. Text: a point a line, three numbers with blanks or commas between; #
// begins a comment. Units: mm, RAS.
#pragma once

#include "core/base/error.h"
#include "core/organ/resect/sheet.h"

#include <string>

namespace ramus::app {

struct SheetFile {
    organ::Sheet sheet;
    bool from_contour = false; // the file does not say which side is removed
};

// Fails, with the file's name, if it cannot be read or holds no sheet.
[[nodiscard]] Result<SheetFile> read_sheet(const std::string& file);

} // namespace ramus::app
