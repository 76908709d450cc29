// How a tree's file is read, as sessions write it.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// `folder`: where the file that it stands in lies. Only what is not as usual; reading throws Refusal.
[[nodiscard]] nlohmann::json reading_json(const io::ReadOptions& reading, const std::filesystem::path& folder);
[[nodiscard]] io::ReadOptions reading_in(const nlohmann::json& value, const std::filesystem::path& folder);

} // namespace ramus::app::session_json
