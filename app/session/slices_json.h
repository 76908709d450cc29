// SliceViews as JSON of session files: "slices". Defaults are omitted. Invalid values throw Refusal
// (app/session/json_values.h).
#pragma once

#include "app/session/slices.h"

#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

[[nodiscard]] nlohmann::json slices_json(const SliceViews& views); // null: nothing differs from the default
[[nodiscard]] SliceViews slices_in(const nlohmann::json& value);

} // namespace ramus::app::session_json
