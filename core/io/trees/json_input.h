// JSON files of trees: read as a whole, with the line of what is wrong, and their numbers without trust.
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

// Whether what begins so may be a JSON object.
[[nodiscard]] bool begins_json_object(std::string_view head);

// The member of an object; null: it has none, or is no object.
[[nodiscard]] const nlohmann::json* json_member(const nlohmann::json& object, const char* key);
// The same where it is a list.
[[nodiscard]] const nlohmann::json* json_list(const nlohmann::json& object, const char* key);
// Its text; empty: there is none.
[[nodiscard]] std::string json_text(const nlohmann::json& object, const char* key);
// A list of three numbers.
[[nodiscard]] std::optional<glm::dvec3> json_position(const nlohmann::json* value);
// A number; none where it is missing, or no number at all.
[[nodiscard]] std::optional<double> json_real(const nlohmann::json* value);
// A whole number from 0 to below kNoJsonIndex; kNoJsonIndex: it is none.
inline constexpr std::uint32_t kNoJsonIndex = std::numeric_limits<std::uint32_t>::max();
[[nodiscard]] std::uint32_t json_index(const nlohmann::json& value);

} // namespace ramus::io
