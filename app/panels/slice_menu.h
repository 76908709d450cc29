// Entries of the menu of the right button over a slice.
#pragma once

#include "app/panels/context_menu.h"
#include "app/panels/interface.h"

#include <string>
#include <vector>

namespace ramus::app {

// `branch`: the vessel under the pointer; kNoBranch: none. Returns the chosen command line; empty: none.
[[nodiscard]] std::vector<std::string> draw_slice_entries(const InterfaceContext& context, const SliceSpot& spot,
                                                          int branch);

} // namespace ramus::app
