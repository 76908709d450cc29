// What people have marked on a tree, as a session file has it: states, lesions, cuts, names, measurements, options.
#pragma once

#include "app/session/session.h"

#include <array>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// All that a file lists: normal branches are the rest.
inline constexpr std::array kListedStates{render::BranchState::kHighlighted, render::BranchState::kDefocused,
                                          render::BranchState::kHidden};

[[nodiscard]] nlohmann::json options_json(const Marks& marks);
[[nodiscard]] nlohmann::json measurement_json(const Measurement& m);

// Throw Refusal (app/session/json_values.h).
void read_options(const nlohmann::json& value, Marks& marks);
void read_states(const nlohmann::json& value, Marks& marks);
void read_plans(const nlohmann::json& value, Marks& marks); // lesions, cuts, names, measurements

} // namespace ramus::app::session_json
