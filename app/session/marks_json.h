// What people have marked on a tree, as a session file has it: states, lesions, cuts, names, measurements, options.
#pragma once

#include "app/session/session.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// All that a file lists: normal branches are the rest.
inline constexpr std::array kListedStates{render::BranchState::kHighlighted, render::BranchState::kDefocused,
                                          render::BranchState::kHidden};

[[nodiscard]] nlohmann::json options_json(const Marks& marks);
[[nodiscard]] nlohmann::json measurement_json(const Measurement& m);

// Throw Refusal (app/session/json_values.h).
[[nodiscard]] std::string mesh_axes_in(const nlohmann::json& value); // "LPS" or "RAS"
void read_options(const nlohmann::json& value, Marks& marks);
void read_states(const nlohmann::json& value, Marks& marks);
void read_plans(const nlohmann::json& value, Marks& marks); // lesions, cuts, names, measurements

// What a session file says of what is seen beside the tree: other surfaces of the same vessels, and context.

// How a file in `folder` names another: from there on if it lies below, else from the root.
[[nodiscard]] std::filesystem::path written_path(const std::filesystem::path& file,
                                                 const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json comparison_json(const Comparison& comparison, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json deviation_json(const DeviationChoice& choice, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json context_json(const ContextItem& item, const std::filesystem::path& folder);

// Throw Refusal (app/session/json_values.h).
[[nodiscard]] Comparison comparison_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] DeviationChoice deviation_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] tree::System system_in(const nlohmann::json& value);
[[nodiscard]] ContextItem context_item(const nlohmann::json& value, const std::filesystem::path& folder);

} // namespace ramus::app::session_json
