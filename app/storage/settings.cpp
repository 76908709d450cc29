#include "app/storage/settings.h"

#include "app/session/json_text.h"
#include "app/session/json_values.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <fstream>

namespace ramus::app {

namespace fs = std::filesystem;
using namespace session_json;

namespace {

constexpr const char* kFile = "settings.json";

} // namespace

fs::path Settings::folder_of(const std::string& kind) const {
    const auto found = folders.find(kind);
    return found == folders.end() ? fs::path() : found->second;
}

json to_json(const Settings& settings) {
    json value{{"panel_open", settings.panel_open},
               {"recent_files", settings.recent_files},
               {"folders", json::object()},
               {"drop_beside", settings.drop_beside},
               {"light_theme", settings.light_theme},
               {"welcome", settings.welcome},
               {"background", kGrounds[static_cast<std::size_t>(settings.ground)].key}};
    for (const auto& [kind, folder] : settings.folders) value["folders"][kind] = folder.string();
    if (settings.window.x > 0) value["window"] = {settings.window.x, settings.window.y};
    if (settings.ui_scale > 0.0) value["ui_scale"] = settings.ui_scale;
    return value;
}

Result<Settings> settings_from_json(const json& value, const std::string& where) {
    try {
        if (!value.is_object()) throw Refusal{"the settings are not an object"};
        Settings settings;
        if (value.contains("ui_scale"))
            settings.ui_scale = number(value["ui_scale"], "ui_scale", kLeastUiScale, kMostUiScale);
        if (value.contains("window")) {
            const json& size = value["window"];
            if (!size.is_array() || size.size() != 2) throw Refusal{"window is not [width, height]"};
            settings.window = {integer(size[0], "width of the window", 480, 16384),
                               integer(size[1], "height of the window", 360, 16384)};
        }
        for (const auto& [name, member] :
             {std::pair("panel_open", &Settings::panel_open), std::pair("drop_beside", &Settings::drop_beside),
              std::pair("light_theme", &Settings::light_theme), std::pair("welcome", &Settings::welcome)}) {
            if (!value.contains(name)) continue;
            if (!value[name].is_boolean()) throw Refusal{std::string(name) + " is neither true nor false"};
            settings.*member = value[name].get<bool>();
        }
        if (value.contains("background")) {
            const std::string wanted = text(value["background"], "background");
            const auto* const row = std::ranges::find(kGrounds, wanted, &GroundRow::key);
            if (row == kGrounds.end() || row->ground == Ground::kTransparent)
                throw Refusal{"background is neither dark, grey nor white"};
            settings.ground = row->ground;
        }
        if (value.contains("recent_files"))
            settings.recent_files = integer(value["recent_files"], "recent_files", 0, 100);
        if (value.contains("last_folder")) // of an earlier version
            settings.folders["open"] = text(value["last_folder"], "last_folder");
        if (value.contains("folders")) {
            if (!value["folders"].is_object()) throw Refusal{"folders is not an object"};
            for (const auto& [kind, folder] : value["folders"].items())
                settings.folders[kind] = text(folder, "folders");
        }
        return settings;
    } catch (const Refusal& refusal) {
        return fail(refusal.what, where);
    }
}

StoredSettings read_settings(const fs::path& folder) {
    std::error_code error;
    const fs::path file = folder / kFile;
    if (folder.empty() || !fs::exists(file, error)) return {};
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto value = io::parsed_json(text, file.string());
    auto settings = value ? settings_from_json(*value, file.string()) : tl::unexpected(value.error());
    if (settings) return {*settings, {}};
    const fs::path aside = file.string() + ".bad";
    fs::rename(file, aside, error);
    return {{},
            settings.error().message() + "; the settings start anew" +
                (error ? "" : ", the old ones are " + aside.filename().string())};
}

Result<void> write_settings(const Settings& settings, const fs::path& folder) {
    if (folder.empty()) return fail("there is no folder for settings", {}, "set XDG_CONFIG_HOME or HOME");
    std::error_code error;
    fs::create_directories(folder, error);
    const auto text = json_text(to_json(settings), (folder / kFile).string());
    return text ? io::write_file(folder / kFile, *text) : tl::unexpected(text.error());
}

} // namespace ramus::app
