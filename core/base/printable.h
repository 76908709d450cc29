// Makes text from files safe to print: the result cannot control a terminal or start a line of its own.
#pragma once

#include <string>
#include <string_view>

namespace ramus {

// Replaces control characters (U+0000 to U+001F, U+007F to U+009F) and bytes that are not part of a UTF-8 sequence by
// escapes such as "\u001b". All other text stays. Idempotent. Surrogates and overlong sequences of three and four bytes
// are not checked.
[[nodiscard]] std::string printable(std::string_view text);

// The same, but line feeds and tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

} // namespace ramus
