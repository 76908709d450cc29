// JSON as the text of a file. Names of files and folders are bytes, JSON is UTF-8: what cannot be told is an error, not
// an exception.
#pragma once

#include "core/base/error.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

// Indented by one, with a line end. `where` names the file in the message.
[[nodiscard]] Result<std::string> json_text(const nlohmann::json& value, const std::string& where);

} // namespace ramus::app
