#include "app/storage/user_folders.h"

#include "app/session/document.h"
#include "core/io/file_format.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <pwd.h>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace ramus::app {

namespace fs = std::filesystem;

namespace user_folders {

namespace {

// The XDG rules require ignoring relative paths.
fs::path absolute_from(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value == '/' ? fs::path(value) : fs::path();
}

fs::path base(const char* variable, const char* below_home) {
    if (fs::path set = absolute_from(variable); !set.empty()) return set;
    const fs::path own = home();
    return own.empty() ? own : own / below_home;
}

// XDG_PICTURES_DIR="$HOME/Pictures" in user-dirs.dirs; otherwise the environment variable; otherwise the English name.
fs::path own_folder(const std::string& variable, const char* usual) {
    std::error_code ignored;
    const auto when_there = [&](const fs::path& folder) {
        return fs::is_directory(folder, ignored) ? folder : fs::path();
    };
    if (const fs::path set = absolute_from(variable.c_str()); !set.empty()) return when_there(set);
    std::ifstream stream(base("XDG_CONFIG_HOME", ".config") / "user-dirs.dirs");
    for (std::string line; std::getline(stream, line);) {
        const std::string start = variable + "=\"";
        if (!line.starts_with(start) || line.back() != '"' || line.size() <= start.size()) continue;
        const std::string value = line.substr(start.size(), line.size() - start.size() - 1);
        constexpr std::string_view kHome = "$HOME/";
        if (value.starts_with(kHome)) return when_there(home() / value.substr(kHome.size()));
        return value.starts_with('/') ? when_there(value) : fs::path();
    }
    return home().empty() ? fs::path() : when_there(home() / usual);
}

} // namespace

fs::path home() {
    if (fs::path set = absolute_from("HOME"); !set.empty()) return set;
    std::array<char, 4096> buffer{};
    passwd entry{};
    passwd* found = nullptr;
    if (::getpwuid_r(::getuid(), &entry, buffer.data(), buffer.size(), &found) != 0 || found == nullptr) return {};
    return found->pw_dir != nullptr && *found->pw_dir == '/' ? fs::path(found->pw_dir) : fs::path();
}

fs::path settings() {
    const fs::path folder = base("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "ramus";
}

fs::path state() {
    const fs::path folder = base("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "ramus";
}

fs::path pictures() { return own_folder("XDG_PICTURES_DIR", "Pictures"); }
fs::path documents() { return own_folder("XDG_DOCUMENTS_DIR", "Documents"); }

std::error_code make_private(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    // Older versions created it readable by others.
    if (!error) fs::permissions(folder, fs::perms::owner_all, error);
    return error;
}

bool writable(const fs::path& folder) {
    std::error_code ignored;
    return !folder.empty() && fs::is_directory(folder, ignored) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

} // namespace user_folders

namespace {

// "case" of case.nii.gz, case.seg.nrrd and case.mrk.json.
std::string bare_name(const fs::path& file) {
    std::string name = io::without_gz(file.filename()).stem().string();
    for (const std::string_view kind : {".mrk", ".seg", ".ramus"})
        if (name.size() > kind.size() && name.ends_with(kind)) name.resize(name.size() - kind.size());
    return name;
}

} // namespace

fs::path suggested_file(const Document& document, std::string_view extension) {
    const fs::path& file = document.file();
    const fs::path tree = document.subject();
    const bool session = extension == ".ramus.json";
    if (session && !file.empty()) return file;

    std::error_code ignored;
    fs::path folder = fs::current_path(ignored);
    const fs::path beside_tree = tree.parent_path();
    for (const fs::path& candidate : {file.parent_path(), extension == ".png" ? user_folders::pictures() : fs::path(),
                                      beside_tree, user_folders::documents(), user_folders::home()}) {
        if (!user_folders::writable(candidate)) continue;
        folder = candidate;
        break;
    }
    const std::string stem = tree.empty() ? "ramus" : bare_name(tree);
    fs::path free = folder / (stem + std::string(extension));
    for (int i = 2; fs::exists(free, ignored); ++i)
        free = folder / (stem + "-" + std::to_string(i) + std::string(extension));
    return free;
}

} // namespace ramus::app
