// Converts JSON to the text of a file. File names are bytes but JSON is UTF-8; names that cannot be encoded are an
// error, not an exception.
#pragma once

#include "core/base/error.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

// Indented by one blank, with a final newline. `where` names the file in errors.
[[nodiscard]] Result<std::string> json_text(const nlohmann::json& value, const std::string& where);

} // namespace ramus::app
