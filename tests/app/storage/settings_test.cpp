#include "app/session/document.h"
#include "app/storage/settings.h"
#include "app/storage/user_folders.h"
#include "tests/support/temporary_folder.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <unistd.h>

using namespace ramus;
using namespace ramus::app;
namespace fs = std::filesystem;

namespace {

// The environment of a test, put back afterwards.
class Environment {
public:
    Environment() {
        for (const char* name :
             {"HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR"}) {
            const char* value = std::getenv(name);
            before_[name] = value == nullptr ? std::nullopt : std::optional<std::string>(value);
            ::unsetenv(name);
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() {
        for (const auto& [name, value] : before_)
            value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    }
    void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }

private:
    std::map<std::string, std::optional<std::string>> before_;
};

Document document_of(const fs::path& tree, const fs::path& file = {}) {
    Document document;
    Session session;
    session.tree.path = tree;
    document.open(nullptr, session, nullptr, file);
    return document;
}

} // namespace

TEST_CASE("settings are restored from their file") {
    const TemporaryFolder folder;
    Settings settings;
    settings.ui_scale = 1.25;
    settings.window = {1920, 1080};
    settings.panel_open = false;
    settings.recent_files = 3;
    settings.folders = {{"open", "/data/trees of \"1999\""}, {"export", "/out"}};
    settings.drop_beside = true;
    const fs::path place = folder.path() / "ramus";
    REQUIRE(write_settings(settings, place));
    const StoredSettings read = read_settings(place);
    CHECK(read.trouble.empty());
    CHECK(read.settings == settings);
    // What is missing is as usual; what another version wrote is left alone.
    const auto some = settings_from_json(nlohmann::json::parse(R"({"recent_files": 0, "mood": "blue"})"), "s");
    REQUIRE(some);
    CHECK(some->recent_files == 0);
    CHECK(some->window == Settings{}.window);
}

TEST_CASE("invalid settings are reported and kept in another file, and the program starts") {
    const TemporaryFolder folder;
    CHECK(read_settings(folder.path()).trouble.empty()); // none yet
    CHECK(read_settings({}).trouble.empty());
    for (const char* text : {"", "no JSON", "[]", R"({"window": [10, 10]})", R"({"window": "large"})",
                             R"({"ui_scale": 99})", R"({"panel_open": 1})", R"({"recent_files": 2.5})",
                             R"({"last_folder": {}})", R"({"folders": 3})", R"({"drop_beside": "yes"})"}) {
        CAPTURE(text);
        std::ofstream(folder.path() / "settings.json") << text;
        const StoredSettings read = read_settings(folder.path());
        CHECK(read.trouble.find("settings.json.bad") != std::string::npos);
        CHECK(read.settings == Settings{});
        CHECK(folder.names() == std::vector<std::string>{"settings.json.bad"});
        CHECK(folder.text("settings.json.bad") == text);
        REQUIRE(write_settings({}, folder.path()));
        CHECK(read_settings(folder.path()).trouble.empty());
        fs::remove(folder.path() / "settings.json");
    }
    CHECK_FALSE(write_settings({}, {}));
    std::ofstream(folder.path() / "file") << "in the way";
    CHECK_FALSE(write_settings({}, folder.path() / "file" / "ramus"));
}

TEST_CASE("folders follow the XDG specification") {
    Environment environment;
    environment.set("HOME", "/home/ada");
    CHECK(user_folders::settings() == "/home/ada/.config/ramus");
    CHECK(user_folders::state() == "/home/ada/.local/state/ramus");
    environment.set("XDG_CONFIG_HOME", "/etc/ada");
    environment.set("XDG_STATE_HOME", "/var/ada");
    CHECK(user_folders::settings() == "/etc/ada/ramus");
    CHECK(user_folders::state() == "/var/ada/ramus");
    environment.set("XDG_STATE_HOME", "relative"); // to be ignored, say the rules
    CHECK(user_folders::state() == "/home/ada/.local/state/ramus");
    environment.set("XDG_STATE_HOME", "");
    CHECK(user_folders::state() == "/home/ada/.local/state/ramus");
    // Without HOME the system's user database counts; whatever it says, nothing is relative.
    ::unsetenv("HOME");
    CHECK((user_folders::home().empty() || user_folders::home().is_absolute()));
    ::unsetenv("XDG_CONFIG_HOME");
    CHECK((user_folders::settings().empty() || user_folders::settings().is_absolute()));
}

TEST_CASE("pictures and documents are saved in the user's folders") {
    const TemporaryFolder folder;
    Environment environment;
    environment.set("HOME", folder.path());
    CHECK(user_folders::pictures().empty()); // it does not exist
    fs::create_directories(folder.path() / "Pictures");
    CHECK(user_folders::pictures() == folder.path() / "Pictures");
    fs::create_directories(folder.path() / "Bilder");
    fs::create_directories(folder.path() / ".config");
    std::ofstream(folder.path() / ".config" / "user-dirs.dirs")
        << "# comment\nXDG_DOCUMENTS_DIR=\"" << folder.path().string() << "\"\nXDG_PICTURES_DIR=\"$HOME/Bilder\"\n";
    CHECK(user_folders::pictures() == folder.path() / "Bilder");
    CHECK(user_folders::documents() == folder.path());
}

TEST_CASE("a file saved without a name goes to the folder of the tree or session, and never replaces another file") {
    const TemporaryFolder folder;
    Environment environment;
    const fs::path home = folder.path() / "home";
    const fs::path data = folder.path() / "data";
    fs::create_directories(home / "Pictures");
    fs::create_directories(data);
    environment.set("HOME", home);
    const fs::path tree = data / "liver.swc";

    CHECK(suggested_file(document_of(tree), ".ramus.json") == data / "liver.ramus.json");
    std::ofstream(data / "liver.ramus.json") << "{}";
    CHECK(suggested_file(document_of(tree), ".ramus.json") == data / "liver-2.ramus.json");
    CHECK(suggested_file(document_of(tree, data / "liver.ramus.json"), ".ramus.json") == data / "liver.ramus.json");

    CHECK(suggested_file(document_of(tree), ".png") == home / "Pictures" / "liver.png");
    CHECK(suggested_file(document_of(tree), ".csv") == data / "liver.csv");
    for (const char* name : {"case.nii.gz", "case.seg.nrrd", "case.mrk.json", "case.swc.gz"})
        CHECK(suggested_file(document_of(data / name), ".ply") == data / "case.ply");
    CHECK(suggested_file(document_of(tree, data / "plan.ramus.json"), ".png") == data / "liver.png");
    std::ofstream(data / "liver.png") << "picture";
    CHECK(suggested_file(document_of(tree, data / "plan.ramus.json"), ".png") == data / "liver-2.png");

    // A folder that is gone, or that cannot be written (root can write everywhere).
    CHECK(suggested_file(document_of("/nowhere/liver.swc"), ".ramus.json") == home / "liver.ramus.json");
    fs::create_directories(home / "Documents");
    CHECK(suggested_file(document_of("/nowhere/liver.swc"), ".ramus.json") == home / "Documents" / "liver.ramus.json");
    if (::getuid() != 0) {
        fs::permissions(data, fs::perms::owner_read | fs::perms::owner_exec);
        CHECK(suggested_file(document_of(tree), ".ramus.json") == home / "Documents" / "liver.ramus.json");
        fs::permissions(data, fs::perms::owner_all);
    }
}
