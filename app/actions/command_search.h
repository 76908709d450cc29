// Finds commands by words: in their names, labels and help, and by synonyms from clinics and other programs ("tumour"
// for a lesion, "print" for an export).
#pragma once

#include "app/actions/command_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// Returns commands that match every word, best first; ties are resolved in favour of commands in menus, then by the
// order of the table. Without words returns all. An unknown word is replaced by the nearest known word, to tolerate
// typing errors. Omits entries that cannot be run this way ("dismiss").
[[nodiscard]] std::vector<const Command*> search_commands(std::string_view words);

// Interprets a line of a commands file with arguments: "select 3", "panel surface". Null if it is no such line, if it
// is an entry of its own ("view left"), or if its words match entries ("hide vessels").
[[nodiscard]] const Command* command_given_by(std::string_view line);

// "Select \xE2\x80\xBA Dependents"; for a command without a menu its name as words.
[[nodiscard]] std::string title_of(const Command& command, const Document& document);

// Whether the command needs arguments that its entry does not preset: "select-diameter MIN MAX". Arguments in brackets
// are optional.
[[nodiscard]] bool needs_arguments(const Command& command);

} // namespace ramus::app
