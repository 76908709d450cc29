// Settings: what a person wants of the window every time, kept in settings.json in the settings folder
// (app/storage/user_folders.h). What belongs to a tree is the session's. Reading takes what is missing from the
// defaults and refuses wrong types and values; names that it does not know are another version's, and ignored.
#pragma once

#include "app/picture/ground.h"
#include "core/base/error.h"

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

struct Settings {
    double ui_scale = 0.0; // pixels per point; 0: what the display says
    glm::ivec2 window{0};  // points; 0: what the display suggests, before there was a window
    bool panel_open = true;
    int recent_files = 10;                                // how many are remembered; 0: none
    std::map<std::string, std::filesystem::path> folders; // that files of a kind were last chosen in
    [[nodiscard]] std::filesystem::path folder_of(const std::string& kind) const; // empty: none yet
    bool drop_beside = false; // a mask that is dropped on a tree was last shown beside it, not opened
    bool light_theme = false;
    bool welcome = true;           // a start without a file says what ramus is
    Ground ground = Ground::kDark; // behind the tree in the window
    bool operator==(const Settings&) const = default;
};

inline constexpr double kLeastUiScale = 0.5, kMostUiScale = 4.0;

[[nodiscard]] nlohmann::json to_json(const Settings& settings);
[[nodiscard]] Result<Settings> settings_from_json(const nlohmann::json& json, const std::string& where);

struct StoredSettings {
    Settings settings;
    std::string trouble; // what was wrong with the file; empty: nothing
};
// From `folder`/settings.json. One that cannot be understood is kept beside it as settings.json.bad, where it does not
// get lost when others are written; no file at all is fine.
[[nodiscard]] StoredSettings read_settings(const std::filesystem::path& folder);
// Atomic; makes the folder.
[[nodiscard]] Result<void> write_settings(const Settings& settings, const std::filesystem::path& folder);

} // namespace ramus::app
