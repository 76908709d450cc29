// Options for reading a tree's file as JSON of session files.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// `folder`: of the session file. Defaults are omitted; reading throws Refusal.
[[nodiscard]] nlohmann::json reading_json(const io::ReadOptions& reading, const std::filesystem::path& folder);
[[nodiscard]] io::ReadOptions reading_in(const nlohmann::json& value, const std::filesystem::path& folder);

// The keys "channel" and "time" of an object; missing ones are not chosen.
void write_part(const io::VolumePart& part, nlohmann::json& value);
[[nodiscard]] io::VolumePart part_in(const nlohmann::json& value);

} // namespace ramus::app::session_json
