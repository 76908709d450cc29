// What a session file says of what is seen beside the tree: other surfaces of the same vessels, and context.
#pragma once

#include "app/session/session.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// How a file in `folder` names another: from there on if it lies below, else from the root.
[[nodiscard]] std::filesystem::path written_path(const std::filesystem::path& file,
                                                 const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json comparison_json(const Comparison& comparison, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json context_json(const ContextItem& item, const std::filesystem::path& folder);

// Throw Refusal (app/session/json_values.h).
[[nodiscard]] Comparison comparison_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] ContextItem context_item(const nlohmann::json& value, const std::filesystem::path& folder);

} // namespace ramus::app::session_json
