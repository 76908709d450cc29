// The columns of the table of branches: which there is room for, how wide they are, and their headings.
#pragma once

#include "app/panels/branch_list.h"
#include "app/session/document.h"
#include "app/session/quantity.h"

#include <imgui.h>
#include <string>

namespace ramus::app {

enum BranchColumn : ImGuiID { kMark, kId, kName, kSystem, kFirstQuantity }; // those of quantities follow

[[nodiscard]] std::string number_text(const QuantityRow& row, double value);

// Of the table that has begun. No heading and no number is cut: where there is no room for all, some columns are left
// out. `room`: pixels.
void set_up_columns(const BranchList& list, const Document& document, float room);
void draw_branch_headings(const Lengths& lengths);

} // namespace ramus::app
