// Marks as JSON of session files. Invalid values throw Refusal (app/session/json_values.h). `folder`: of the session
// file.
#pragma once

#include "app/session/session.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// The path written into a file in `folder`: relative if `file` lies below `folder`, otherwise absolute.
[[nodiscard]] std::filesystem::path written_path(const std::filesystem::path& file,
                                                 const std::filesystem::path& folder);

// `marks` must contain the lesions that measurements refer to.
[[nodiscard]] nlohmann::json measurement_json(const Measurement& m, const Marks& marks);
[[nodiscard]] Measurement measurement_in(const nlohmann::json& value, const Marks& marks);
[[nodiscard]] std::string mesh_axes_in(const nlohmann::json& value); // "LPS" or "RAS"

[[nodiscard]] nlohmann::json comparison_json(const Comparison& comparison, const std::filesystem::path& folder);
[[nodiscard]] Comparison comparison_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json deviation_json(const DeviationChoice& choice, const std::filesystem::path& folder);
[[nodiscard]] DeviationChoice deviation_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json context_json(const ContextItem& item, const std::filesystem::path& folder);
[[nodiscard]] ContextItem context_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] tree::System system_in(const nlohmann::json& value);

} // namespace ramus::app::session_json
