// The way JSON comes in, and the way it goes out to people and programs. Files of trees have more on top of it
// (trees/json_input.h); what must be told apart to the byte, as names in sessions, is written by who needs that.
#pragma once

#include "core/base/error.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ramus::io {

// Lists and objects in each other. Copying and writing a value call themselves for each level; formats here have ten.
inline constexpr int kDeepestJson = 64;

// Fails on what is no JSON, on what nests deeper than kDeepestJson, and on numbers that no double can hold. Members
// called `left_out` are not kept: what nothing needs takes no memory.
[[nodiscard]] Result<nlohmann::json> parsed_json(std::string_view text, const std::string& name,
                                                 std::string_view left_out = {});

// As text, whatever bytes its names hold: those that are no UTF-8 are replaced. `indent` below 0: on one line.
[[nodiscard]] std::string printed_json(const nlohmann::json& value, int indent = 2);
[[nodiscard]] std::string printed_json(const nlohmann::ordered_json& value, int indent = 2);

} // namespace ramus::io
