// What a step of the history is called, from the command that made it: "hide 12 branches", "lasso 3 branches",
// "surface detail 24". The menu puts "Undo" or "Redo" in front.
#pragma once

#include "app/actions/command_table.h"
#include "app/session/marks_change.h"

#include <string>

namespace ramus::app {

// `after`: the marks as `change` left them.
[[nodiscard]] std::string phrase_of(const Command& command, Arguments arguments, const MarksChange& change,
                                    const Marks& after);

} // namespace ramus::app
