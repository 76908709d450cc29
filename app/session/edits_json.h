// Edits of the tree as JSON of session files: {"edit": "cut", "branches": [12], "at": [0.4], "value": 3}.
#pragma once

#include "core/tree/edit_tree.h"

#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

[[nodiscard]] nlohmann::json edits_json(const std::vector<tree::Edit>& edits);
// Throws Refusal (app/session/json_values.h).
[[nodiscard]] std::vector<tree::Edit> edits_in(const nlohmann::json& list);

} // namespace ramus::app::session_json
