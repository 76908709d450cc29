// Parses JSON within limits of depth and memory, and prints it as valid UTF-8. trees/json_input.h adds helpers for
// files of trees. Not for texts that must keep invalid UTF-8, such as names in sessions: printing replaces it.
#pragma once

#include "core/base/error.h"

#include <functional>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Most levels of nested lists and objects, because the library copies and prints recursively. Formats here have ten.
inline constexpr int kDeepestJson = 64;

// Most memory of the parsed values, estimated, without lists that are consumed while reading. Needed because values are
// larger than their text: "1," takes 24 bytes, and "{}," 88.
inline constexpr std::size_t kMostJsonBytes = std::size_t{128} << 20;

// The keys that lead from the root to a list; "" stands for an element of another list.
using JsonPath = std::span<const std::string>;
// Consumes the elements of a list one by one. The result then has an empty list in their place. An element that is
// itself a consumed list arrives empty. May throw.
using JsonElements = std::function<void(nlohmann::json& element)>;
// Called at the beginning of each list; returns its consumer, or an empty function to keep the list. A list whose key
// is there twice is asked for twice; the result keeps the last.
using JsonLists = std::function<JsonElements(JsonPath list)>;

// Parses a whole text. `name`: the file in messages. Fails, with the line where there is one, on invalid or empty text,
// on nesting deeper than kDeepestJson, on numbers beyond double precision, and on values of more than kMostJsonBytes at
// a time. Passes on exceptions of `lists` and its consumers.
[[nodiscard]] Result<nlohmann::json> parsed_json(std::string_view text, const std::string& name,
                                                 const JsonLists& lists = {});

// The keys of a JSON object at its top level, in their order. Keeps nothing else in memory. Empty: the text is no
// object, no valid JSON, or has more than 1,000 keys.
[[nodiscard]] std::vector<std::string> json_names(std::istream& text);

// Prints a value; replaces bytes that are not UTF-8. `indent`: blanks for each level; below 0: everything on one line.
[[nodiscard]] std::string printed_json(const nlohmann::json& value, int indent = 2);
[[nodiscard]] std::string printed_json(const nlohmann::ordered_json& value, int indent = 2);

} // namespace ramus::io
