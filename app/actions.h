// What the commands of the table do, one function each. They share one shape so that the table can hold them.
#pragma once

#include "app/command_table.h"

namespace ramus::app::actions {

#define RAMUS_ACTION(name) Result<void> name(ActionContext& context, Arguments arguments)
RAMUS_ACTION(open);
RAMUS_ACTION(save);
RAMUS_ACTION(shot);
RAMUS_ACTION(quit);
RAMUS_ACTION(undo);
RAMUS_ACTION(redo);
RAMUS_ACTION(select);
RAMUS_ACTION(select_add);
RAMUS_ACTION(select_subtree);
RAMUS_ACTION(select_toggle);
RAMUS_ACTION(select_none);
RAMUS_ACTION(select_dependents);
RAMUS_ACTION(select_upstream);
RAMUS_ACTION(select_invert);
RAMUS_ACTION(dismiss);
RAMUS_ACTION(highlight);
RAMUS_ACTION(defocus);
RAMUS_ACTION(defocus_others);
RAMUS_ACTION(hide);
RAMUS_ACTION(show);
RAMUS_ACTION(show_all);
RAMUS_ACTION(name);
RAMUS_ACTION(view);
RAMUS_ACTION(fit);
RAMUS_ACTION(orthographic);
RAMUS_ACTION(colour_by);
RAMUS_ACTION(panel);
RAMUS_ACTION(surface);
RAMUS_ACTION(help);
#undef RAMUS_ACTION

} // namespace ramus::app::actions
