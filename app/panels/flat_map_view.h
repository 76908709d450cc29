// The cut surface of a resection laid flat, in the side panel.
#pragma once

#include "app/panels/interface.h"
#include "app/picture/flat_map.h"

namespace ramus::app {

// As wide as the panel. A vessel under the pointer is named and highlighted in the picture; a click goes to it.
void draw_flat_map(InterfaceContext& context, const FlatMap& map, const tree::Claims& claims);

} // namespace ramus::app
