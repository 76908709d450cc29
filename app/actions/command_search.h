// Finds commands by words that people type: by their names, labels and help, and by words of clinics and other programs
// that mean the same ("tumour" for a lesion, "print" for an export).
#pragma once

#include "app/actions/command_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// Commands in which every word of `words` is found, the best first; of those that are as good the ones in menus, in the
// order of the table. All of them, without words. A word that is found nowhere counts as the nearest known word that it
// may be a mistyping of. Left out: entries that cannot be given ("dismiss").
[[nodiscard]] std::vector<const Command*> search_commands(std::string_view words);

// The command that a line gives arguments to, as in a commands file: "select 3", "panel surface". Null: it is no such
// line, it is an entry of its own ("view left"), or it has words that entries are found by ("hide vessels").
[[nodiscard]] const Command* command_given_by(std::string_view line);

// "Select \xE2\x80\xBA Dependents"; of a command that is in no menu its name, in words.
[[nodiscard]] std::string title_of(const Command& command, const Document& document);

// Whether it cannot run without arguments that its entry does not give: "select-diameter MIN MAX". Those in brackets
// can be left out.
[[nodiscard]] bool needs_arguments(const Command& command);

} // namespace ramus::app
