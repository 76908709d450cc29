// Settings: the user's preferences for the window, in settings.json in the settings folder
// (app/storage/user_folders.h). Properties of a tree belong to the session. Reading uses defaults for missing names,
// rejects wrong types and values, and ignores unknown names, which may belong to another version.
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
    double ui_scale = 0.0; // pixels per point; 0: the display's
    glm::ivec2 window{0};  // points; 0: suited to the display
    bool panel_open = true;
    int recent_files = 10;                                                        // how many to remember; 0: none
    std::map<std::string, std::filesystem::path> folders;                         // the last folder, by kind of file
    [[nodiscard]] std::filesystem::path folder_of(const std::string& kind) const; // empty: none yet
    bool drop_beside = false; // last choice for a mask dropped on a tree: show it next to the tree
    bool light_theme = false;
    bool welcome = true;           // shows the welcome panel on a start without a file
    Ground ground = Ground::kDark; // background in the window
    bool operator==(const Settings&) const = default;
};

inline constexpr double kLeastUiScale = 0.5, kMostUiScale = 4.0;

[[nodiscard]] nlohmann::json to_json(const Settings& settings);
[[nodiscard]] Result<Settings> settings_from_json(const nlohmann::json& json, const std::string& where);

struct StoredSettings {
    Settings settings;
    std::string trouble; // what is wrong with the file; empty: nothing
};
// Reads `folder`/settings.json; a missing file gives the defaults. An invalid file is kept as settings.json.bad, so
// that later writes do not overwrite it.
[[nodiscard]] StoredSettings read_settings(const std::filesystem::path& folder);
// Atomic; creates the folder.
[[nodiscard]] Result<void> write_settings(const Settings& settings, const std::filesystem::path& folder);

} // namespace ramus::app
