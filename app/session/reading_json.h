// How a tree's file is read, as sessions write it.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

[[nodiscard]] nlohmann::json reading_json(const io::ReadOptions& reading); // only what is not as usual
[[nodiscard]] io::ReadOptions reading_in(const nlohmann::json& value);     // throws Refusal

} // namespace ramus::app::session_json
