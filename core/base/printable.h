// Text from files and names on its way to people: nothing in it can steer a terminal or fake a line.
#pragma once

#include <string>
#include <string_view>

namespace ramus {

// Control characters become "\u001b", as JSON writes them; so do the controls that UTF-8 spells in two bytes, and
// bytes that are no UTF-8 and that a terminal takes for such. All else stays: words of any language, and what has been
// through this before.
[[nodiscard]] std::string printable(std::string_view text);

// The same for a text of several lines: line ends and tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

} // namespace ramus
