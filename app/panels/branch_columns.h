// Columns of the table of branches: which fit, their widths, their headings.
#pragma once

#include "app/panels/branch_list.h"
#include "app/session/document.h"
#include "app/session/quantity.h"

#include <imgui.h>
#include <string>

namespace ramus::app {

enum BranchColumn : ImGuiID { kMark, kId, kName, kSystem, kFirstQuantity }; // columns of quantities follow

[[nodiscard]] std::string number_text(const QuantityRow& row, double value);

// Sets up the columns of the current ImGui table. No heading or number is truncated: columns are dropped if space is
// short. `room`: pixels.
void set_up_columns(const BranchList& list, const Document& document, float room);
void draw_branch_headings(const Lengths& lengths);

} // namespace ramus::app
