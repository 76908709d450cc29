// The way JSON comes in, and the way it goes out to people and programs. Files of trees have more on top of it
// (trees/json_input.h); what must be told apart to the byte, as names in sessions, is written by who needs that.
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

// Lists and objects in each other. Copying and writing a value call themselves for each level; formats here have ten.
inline constexpr int kDeepestJson = 64;

// What the values of a text may take in memory, without lists that are taken as they are read. Two characters of text,
// "1,", are 24 bytes as a value, and "{}," are 88.
inline constexpr std::size_t kMostJsonBytes = std::size_t{128} << 20;

// The keys that lead to a list; "" stands for an element of another list.
using JsonPath = std::span<const std::string>;
// Receives the elements of a list one by one. They are not kept: the list that is in the result is empty. An element
// that is a list, and taken itself, is empty as well. May throw.
using JsonElements = std::function<void(nlohmann::json& element)>;
// Asked at the beginning of each list (of one that is there twice, twice: the last one counts). Empty: it is kept.
using JsonLists = std::function<JsonElements(JsonPath list)>;

// Fails on what is no JSON, on what nests deeper than kDeepestJson, on numbers that no double can hold, and when more
// than kMostJsonBytes would be needed at once. What `lists` or its functions throw goes through.
[[nodiscard]] Result<nlohmann::json> parsed_json(std::string_view text, const std::string& name,
                                                 const JsonLists& lists = {});

// The names at the top of a JSON object, in their order; nothing else is kept. Empty: it is no object, or no valid
// JSON.
[[nodiscard]] std::vector<std::string> json_names(std::istream& text);

// As text, whatever bytes its names hold: those that are no UTF-8 are replaced. `indent` below 0: on one line.
[[nodiscard]] std::string printed_json(const nlohmann::json& value, int indent = 2);
[[nodiscard]] std::string printed_json(const nlohmann::ordered_json& value, int indent = 2);

} // namespace ramus::io
