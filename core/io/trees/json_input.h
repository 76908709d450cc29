// Safe access to parsed JSON of tree files: missing members and values of another type give null, none or "".
#pragma once

#include "core/io/json_text.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::io {

// Whether text that begins with `head` may be a JSON object.
[[nodiscard]] bool begins_json_object(std::string_view head);

// The member `key`. Null: `object` has none, or is no object.
[[nodiscard]] const nlohmann::json* json_member(const nlohmann::json& object, const char* key);
// The member `key` if it is a list, else null.
[[nodiscard]] const nlohmann::json* json_list(const nlohmann::json& object, const char* key);
// The text of the member `key`. Empty: it is missing or no text.
[[nodiscard]] std::string json_text(const nlohmann::json& object, const char* key);
// A list of three numbers as a position. None: null, or another value.
[[nodiscard]] std::optional<glm::dvec3> json_position(const nlohmann::json* value);
// A number. None: null, or another value.
[[nodiscard]] std::optional<double> json_real(const nlohmann::json* value);
// A whole number from 0 to kNoJsonIndex - 1; kNoJsonIndex for any other value.
inline constexpr std::uint32_t kNoJsonIndex = std::numeric_limits<std::uint32_t>::max();
[[nodiscard]] std::uint32_t json_index(const nlohmann::json& value);

} // namespace ramus::io
