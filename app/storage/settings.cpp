#include "app/storage/settings.h"

#include "app/session/json_text.h"
#include "core/io/output_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kFile = "settings.json";

struct Refusal {
    std::string what;
};

double number(const json& value, const std::string& name, double least, double most) {
    if (!value.is_number()) throw Refusal{name + " is not a number"};
    const auto found = value.get<double>();
    if (!(found >= least && found <= most)) throw Refusal{name + " " + value.dump() + " is out of range"};
    return found;
}

int integer(const json& value, const std::string& name, int least, int most) {
    if (!value.is_number_integer()) throw Refusal{name + " is not a whole number"};
    return static_cast<int>(number(value, name, least, most));
}

} // namespace

json to_json(const Settings& settings) {
    json value{{"window", {settings.window.x, settings.window.y}},
               {"panel_open", settings.panel_open},
               {"recent_files", settings.recent_files},
               {"last_folder", settings.last_folder.string()},
               {"drop_beside", settings.drop_beside}};
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
        if (value.contains("panel_open")) {
            if (!value["panel_open"].is_boolean()) throw Refusal{"panel_open is neither true nor false"};
            settings.panel_open = value["panel_open"].get<bool>();
        }
        if (value.contains("drop_beside")) {
            if (!value["drop_beside"].is_boolean()) throw Refusal{"drop_beside is neither true nor false"};
            settings.drop_beside = value["drop_beside"].get<bool>();
        }
        if (value.contains("recent_files"))
            settings.recent_files = integer(value["recent_files"], "recent_files", 0, 100);
        if (value.contains("last_folder")) {
            if (!value["last_folder"].is_string()) throw Refusal{"last_folder is not a text"};
            settings.last_folder = value["last_folder"].get<std::string>();
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
    const json value = json::parse(stream, nullptr, false);
    auto settings = value.is_discarded() ? Result<Settings>(fail("this is not JSON", file.string()))
                                         : settings_from_json(value, file.string());
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
